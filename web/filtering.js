// One environment at a time: a newer one ends the one that is being filtered.
let current = null;

export class Superseded extends Error {}

// job: { sky } or { bytes, name }, and size. Resolves to { packed, seconds }.
export function filterEnvironment(job, onProgress) {
  if (current) {
    current.worker.terminate();
    current.reject(new Superseded('another environment was asked for'));
  }
  const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  return new Promise((resolve, reject) => {
    current = { worker, reject };
    const end = () => {
      worker.terminate();
      if (current?.worker === worker) current = null;
    };
    worker.onerror = (event) => {
      end();
      reject(new Error(event.message || 'the worker could not be started'));
    };
    worker.onmessage = ({ data }) => {
      if (data.share !== undefined) return onProgress(data.share);
      end();
      if (data.error) reject(new Error(data.error));
      else resolve(data);
    };
    worker.postMessage(job);
  });
}
