// When things come for the first time: `performance.getEntriesByType('mark')` tells where time goes.

/** Notes when something comes for the first time. */
export function first(name) {
  if (performance.getEntriesByName(name, 'mark').length === 0) performance.mark(name);
}
