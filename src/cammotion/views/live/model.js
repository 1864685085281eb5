// The model of a module without a kernel: what a widget's model is to it in a notebook.

export function modelOf(data) {
  const listeners = {};
  return {
    get: (key) => data[key],
    set(key, value) {
      data[key] = value;
      for (const listen of listeners[`change:${key}`] ?? []) listen();
    },
    save_changes() {},
    on: (key, listen) => (listeners[key] ??= new Set()).add(listen),
    off: (key, listen) => listeners[key]?.delete(listen),
  };
}
