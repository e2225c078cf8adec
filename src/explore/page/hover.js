// What a tile says about the cell under the pointer.

import { digits } from './dom.js';
import { NOWHERE, SIDE } from './protocol.js';

/** The finest that is known of a place: the tile, and the index of the cell in it. */
export function known(tiles, view, x, y) {
  for (let z = view.level; z >= -12; z--) {
    const [, i, j] = view.cellAt(x, y, z);
    const tile = tiles.get(z, Math.floor(i / SIDE), Math.floor(j / SIDE));
    if (tile) return { tile, z, i, j, at: (j - tile.j * SIDE) * SIDE + (i - tile.i * SIDE) };
  }
  return null;
}

/** A line about a place: its values, that of the layer that is shown, and what moves there. */
export function readout(plane, motions, tiles, view, x, y) {
  const [, i, j] = view.cellAt(x, y);
  const unit = 2 ** -view.level;
  const side = (axis, k) => `${axis.name} = ${told(valueAt(axis, k * unit), valueAt(axis, (k + 1) * unit))}`;
  const place = `${side(plane.x, i)}, ${side(plane.y, j)}`;
  const found = known(tiles, view, x, y);
  if (!found) return { place, words: 'not computed yet' };
  const { tile, at } = found;
  if (tile.motion[at] === NOWHERE) return { place, words: 'no such system: outside the range of its parameters' };
  const motion = motions[tile.motion[at]];
  if (motion && !motion.begins) return { place, words: `${motion.name}: it lies beyond a stop`, motion: tile.motion[at] };
  const words = [motion?.name ?? '…'];
  if (tile.layer > 0) words.unshift(`${plane.layers[tile.layer - 1].title}: ${digits(tile.number[at], 4)}`);
  if (tile.n[at] > 0) words.push(`N = ${tile.n[at]}`);
  words.push(`λ1 = ${digits(tile.exponent[at], 4)}`, `peak velocity ${digits(tile.peak[at], 4)}`);
  return { place, words: words.join(', '), motion: tile.motion[at] };
}

/** A value in as many digits as tell it from that of the next cell. */
function told(value, next) {
  const needed = Math.ceil(Math.log10(Math.abs(value) / Math.abs(next - value))) + 1;
  return digits(value, Number.isFinite(needed) ? Math.max(6, Math.min(15, needed)) : 6);
}

/** The value of an axis at a place, to be read; what is computed is the server's. */
export function valueAt({ first, last, count, log }, place) {
  const share = place / (count - 1);
  return log ? first * (last / first) ** share : first + share * (last - first);
}
