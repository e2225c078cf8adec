// Light and dark: as the machine has it, until the reader chooses.

const KEY = 'impact-atlas-theme';

function stored() {
  try { return localStorage.getItem(KEY); } catch { return null; }
}

/** Applies what was chosen before. */
export function begin() {
  const chosen = stored();
  if (chosen === 'light' || chosen === 'dark') document.documentElement.dataset.theme = chosen;
}

/** Changes between the two. */
export function toggle() {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  root.dataset.theme = dark ? 'light' : 'dark';
  try { localStorage.setItem(KEY, root.dataset.theme); } catch { /* a private window keeps nothing */ }
}
