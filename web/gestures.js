// Mouse, finger, pen and keyboard on the canvas. Movements are in fractions of its height, y upwards.
const wheelStep = 1.0015;
const keyStep = 0.05;

export function listenToGestures(canvas, { orbit, pan, zoom, frame }) {
  const pointers = new Map();

  const middle = () => {
    const all = [...pointers.values()];
    return { x: all.reduce((sum, p) => sum + p.x, 0) / all.length, y: all.reduce((sum, p) => sum + p.y, 0) / all.length };
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });

  canvas.addEventListener('pointermove', (event) => {
    if (!pointers.has(event.pointerId)) return;
    const before = middle();
    const spreadBefore = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = middle();
    const height = Math.max(canvas.clientHeight, 1);
    const x = (after.x - before.x) / height;
    const y = (before.y - after.y) / height;
    if (pointers.size >= 2) {
      pan(x, y);
      if (spreadBefore > 0 && spread() > 0) zoom(spreadBefore / spread());
    } else if (event.shiftKey || (event.buttons & 6) !== 0) {
      pan(x, y);
    } else {
      orbit(x, y);
    }
  });

  for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'])
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));

  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? event.deltaY * 16 : event.deltaY;
    zoom(wheelStep ** pixels);
  }, { passive: false });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());

  const directions = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const direction = directions[event.key];
    if (direction) (event.shiftKey ? pan : orbit)(direction[0] * keyStep, direction[1] * keyStep);
    else if (event.key === '+' || event.key === '=') zoom(1 / 1.1);
    else if (event.key === '-') zoom(1.1);
    else if (event.key === 'Home') frame();
    else return;
    event.preventDefault();
  });
}
