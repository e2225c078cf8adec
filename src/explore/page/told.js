// The motions of each plane by their numbers: the program tells of them once, however often a plane is left and shown again.

export class Told {
  constructor() {
    this.planes = new Map();
  }

  /** Those of a plane, as far as they were told. */
  of(scene) {
    if (!this.planes.has(scene)) this.planes.set(scene, []);
    return this.planes.get(scene);
  }

  /** Adds what a message tells. */
  add({ scene, first, motions }) {
    const all = this.of(scene);
    motions.forEach((motion, k) => { all[first + k] = motion; });
  }

  /** Another connection is told anew. */
  forget() {
    this.planes.clear();
  }
}
