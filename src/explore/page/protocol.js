// What goes between page and server; see protocol.md. The other end is request.rs, reply.rs and tile.rs.

export const VERSION = 1;
export const SIDE = 16;
export const TILE = 1;
export const FILE = 2;
export const NOWHERE = 65535;
export const HEADER = 32;

/** The requests that a page makes, by their types, each with a number `ask` unless nothing answers it. */
export const REQUESTS = ['open', 'want', 'legend', 'axes', 'bar', 'probe', 'curves', 'slice', 'save', 'command', 'cancel'];

/** The messages that a page hears, by their types. */
export const MESSAGES = [
  'hello', 'scene', 'motions', 'legend', 'axes', 'bar', 'motion', 'portrait', 'series', 'multipliers', 'section', 'exponents',
  'coexisting', 'curves', 'slice', 'file', 'command', 'progress', 'done', 'refused', 'failed',
];

/** A message of bytes: a tile with its fields, or a file. */
export function decoded(buffer) {
  const bytes = new DataView(buffer);
  const kind = bytes.getUint8(0);
  if (bytes.getUint8(1) !== VERSION) throw new Error('The program is of another version: load the page anew.');
  if (kind === FILE) return { kind, ask: bytes.getUint32(4, true), content: buffer.slice(8) };
  if (kind !== TILE) throw new Error('An unknown message.');
  const cells = bytes.getUint16(2, true) ** 2;
  let at = HEADER;
  const field = (type) => {
    const values = new type(buffer, at, cells);
    at += values.byteLength;
    return values;
  };
  return {
    kind,
    scene: bytes.getUint32(4, true),
    z: bytes.getInt32(8, true),
    layer: bytes.getUint32(12, true),
    i: bytes.getFloat64(16, true),
    j: bytes.getFloat64(24, true),
    motion: field(Uint16Array),
    n: field(Uint16Array),
    exponent: field(Float32Array),
    peak: field(Float32Array),
    number: field(Float32Array),
  };
}
