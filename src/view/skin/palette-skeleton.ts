/** A character's block of the palette: see `skinning.ts`. */
import { type Bone, type DataTexture, Matrix4, Skeleton } from 'three';
import { setIdentity } from '../../math/mat4.ts';
import { type FloatBlocks, MATRIX_TEXELS } from './float-blocks.ts';

/**
 * A skeleton whose bone matrices are given, in doubles, and end with the identity; with the weights of its character's
 * morphs. Its bone texture is the palette, of which it owns a block.
 */
export class PaletteSkeleton extends Skeleton {
  /** Mᵢ, 16 numbers per joint, column-major, in the character's space; the identity after the last joint. */
  readonly matrices: Float64Array;
  /** φₘ, one per morph. */
  readonly weights: Float64Array;
  /** Texels in the palette: of the first matrix, and of the first four weights. */
  readonly firstMatrix: number;
  readonly firstWeight: number;
  override boneTexture: DataTexture;
  private readonly texels: number;

  /**
   * @param jointCount at least as many as the skin's attachments refer to
   * @param inverseBindings 16 numbers per joint, for exporters; bones past its end get the identity
   */
  constructor(
    private readonly palette: FloatBlocks,
    bones: Bone[],
    jointCount: number,
    inverseBindings: Float64Array,
    morphCount: number,
  ) {
    super(
      bones,
      bones.map((_, j) => {
        const inverse = new Matrix4();
        return 16 * j < inverseBindings.length ? inverse.fromArray(inverseBindings, 16 * j) : inverse;
      }),
    );
    this.boneTexture = palette.texture;
    this.matrices = new Float64Array(16 * (jointCount + 1));
    for (let m = 0; m < this.matrices.length; m += 16) setIdentity(this.matrices, m);
    this.weights = new Float64Array(morphCount);
    const matrixTexels = MATRIX_TEXELS * (jointCount + 1);
    this.texels = matrixTexels + Math.ceil(morphCount / 4);
    this.firstMatrix = palette.allocate(this.texels);
    this.firstWeight = this.firstMatrix + matrixTexels;
    this.upload();
  }

  /** Index of the identity among the matrices. */
  get identityIndex(): number {
    return this.matrices.length / 16 - 1;
  }

  /** Uploads matrices and weights with the next draw. */
  upload(): void {
    this.palette.writeMatrices(this.firstMatrix, this.matrices);
    this.palette.write(this.firstWeight, this.weights);
  }

  /** Called by three.js before drawing; `upload` has already done it. */
  override update(): void {}

  override computeBoneTexture(): this {
    return this;
  }

  /** Gives back its block. (three.js would dispose of the texture, which is everyone's.) */
  override dispose(): void {
    this.palette.release(this.firstMatrix, this.texels);
  }
}
