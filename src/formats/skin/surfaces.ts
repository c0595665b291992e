/**
 * Which triangles have which material, as a `.skin` is read: each block of triangles has the material named last before
 * it. Course files have one of both, in any order; so a lone material after all triangles is theirs too.
 */
import type { Material, Surface } from '../../model/skin.ts';
import { warnRepeated } from '../grammar.ts';
import type { Mark, Tokens } from '../tokens.ts';

/** Collects the materials and triangle blocks of a `.skin` into surfaces: ranges of triangles with one material. */
export class Surfaces {
  private readonly all: { material?: Material; triangleStart: number; triangleCount: number }[] = [];
  private current: Material | undefined;
  /** Place of a material without triangles so far. */
  private waiting: Mark | undefined;
  private hasMaterial = false;

  /** At the keyword. */
  beginMaterial(t: Tokens): void {
    if (this.waiting) {
      warnRepeated(t, 'material');
      t.forget(this.waiting);
    }
    this.waiting = t.mark();
  }

  /** Takes the material that was read: the triangles that follow have it. */
  endMaterial(material: Material): void {
    this.current = material;
  }

  /** At the keyword. */
  beginTriangles(t: Tokens): void {
    if (this.all.length > 0 && !this.current) {
      t.warn('repeated', 'triangles appears a second time, with no material before it.', 'both are used');
    }
    if (this.waiting) t.forget(this.waiting);
    this.waiting = undefined;
  }

  /**
   * Adds the triangles that were read to the surface of the current material.
   * @param triangleCount in this block
   */
  endTriangles(triangleCount: number): void {
    const { all, current } = this;
    const last = all.at(-1);
    if (current) this.hasMaterial = true;
    if (last && last.material === current) {
      last.triangleCount += triangleCount;
      return;
    }
    const triangleStart = last ? last.triangleStart + last.triangleCount : 0;
    all.push({ ...(current && { material: current }), triangleStart, triangleCount });
  }

  /** After the whole file. */
  end(t: Tokens): readonly Surface[] {
    const { all, current, waiting } = this;
    if (all.length === 0) return [{ ...(current && { material: current }), triangleStart: 0, triangleCount: 0 }];
    if (!waiting || !current) return all;
    if (!this.hasMaterial) return all.map((surface) => ({ ...surface, material: current }));
    const message = `Expected triangles after the material${current.name && ` "${current.name}"`}, found none.`;
    t.report.warn('material-unused', message, t.placeOf(waiting, 'warning'), 'the material is left out');
    return all;
  }
}
