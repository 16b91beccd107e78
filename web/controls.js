// Controls made from the tables of techniques and parameters, each with its label.

export function fillSelect(select, entries) {
  select.replaceChildren(...entries.map(({ name, title }) => {
    const option = new Option(name, name);
    if (title) option.title = title;
    return option;
  }));
}

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

const readable = (name) => name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' ');

function makeInput(parameter, id) {
  if (parameter.choices.length > 0) {
    const select = element('select', { id });
    parameter.choices.forEach((choice, i) => select.append(new Option(choice, i)));
    select.value = String(parameter.initial);
    return select;
  }
  if (parameter.whole && parameter.minimum === 0 && parameter.maximum === 1)
    return element('input', { id, type: 'checkbox', checked: parameter.initial === 1 });
  const input = element('input', { id, type: 'range', min: parameter.minimum, max: parameter.maximum });
  input.step = parameter.whole ? '1' : 'any';  // else values would snap to steps from the minimum
  input.value = String(parameter.initial);
  return input;
}

export const valueOf = (input) => (input.type === 'checkbox' ? Number(input.checked) : Number(input.value));

export function showValue(input) {
  const output = input.parentElement?.querySelector('output');
  if (output) output.textContent = String(Number(Number(input.value).toPrecision(3)));
}

// Calls onChange with "name:key=value,..." whenever one is turned.
export function makeParameters(container, technique, onChange) {
  const inputs = technique.parameters.map((parameter) => {
    const id = `${container.id}-${parameter.name}`;
    const input = makeInput(parameter, id);
    input.title = parameter.meaning;
    const row = element('div', { className: 'row' },
      element('label', { htmlFor: id, textContent: readable(parameter.name), title: parameter.meaning }), input);
    if (input.type === 'range') row.append(element('output', { htmlFor: id }));
    input.setAttribute('aria-description', parameter.meaning);
    return { parameter, input, row };
  });
  container.replaceChildren(...inputs.map(({ row }) => row));
  const text = () => technique.name + inputs.map(({ parameter, input }, i) =>
    `${i === 0 ? ':' : ','}${parameter.name}=${valueOf(input)}`).join('');
  for (const { input } of inputs) {
    showValue(input);
    input.addEventListener('input', () => {
      showValue(input);
      onChange(text());
    });
  }
  return text();
}
