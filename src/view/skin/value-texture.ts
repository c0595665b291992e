/** A value per vertex for the GPU, for materials that show one: see `SkinMaterials.heat`. */
import { DataTexture, FloatType, RedFormat } from 'three';

/** Texels per row. */
const ROW = 2048;

export class ValueTexture {
  readonly texture: DataTexture;
  private readonly floats: Float32Array;
  private shown: Float32Array | undefined;

  constructor(readonly count: number) {
    const rows = Math.max(1, Math.ceil(count / ROW));
    const floats = new Float32Array(ROW * rows);
    this.floats = floats;
    this.texture = new DataTexture(floats, ROW, rows, RedFormat, FloatType);
  }

  /** Uploads them with the next draw, unless it is the same array. */
  set(values: Float32Array): void {
    if (values === this.shown) return;
    this.shown = values;
    this.floats.set(values);
    this.texture.needsUpdate = true;
  }

  /** They may have changed since, in the same array. */
  forget(): void {
    this.shown = undefined;
  }

  dispose(): void {
    this.texture.dispose();
  }
}
