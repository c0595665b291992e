/** A skin at one placement, as three.js knows it. */
import {
  type Box3,
  type BufferGeometry,
  DetachedBindMode,
  type Material,
  Matrix4,
  SkinnedMesh,
  type Sphere,
  Vector3,
  Vector4,
} from 'three';
import type { Attachments } from '../../model/skin.ts';
import { addMorphs } from './packed-morphs.ts';
import type { PaletteSkeleton } from './palette-skeleton.ts';
import type { SharedSkin } from './shared-skins.ts';

/** Scratch, never escapes. */
const point = new Vector4();

/**
 * A skin at one placement: what is asked for its vertices, and picked. It is drawn as an instance of a batch: see
 * `drawn-skins.ts`.
 */
export class MarrowSkinnedMesh extends SkinnedMesh<BufferGeometry, Material | Material[]> {
  override readonly matrixWorldAutoUpdate = false;

  /**
   * @param sphere around the posed character, in its own space; kept by reference and updated by its owner, so that
   *   three.js neither iterates over the vertices nor culls by an old position
   */
  constructor(
    readonly shared: SharedSkin,
    override readonly skeleton: PaletteSkeleton,
    material: Material,
    readonly sphere: Sphere,
    box: Box3,
  ) {
    super(shared.geometry, material);
    this.bindMode = DetachedBindMode;
    this.bind(skeleton, new Matrix4());
    this.boundingSphere = sphere;
    this.boundingBox = box;
    this.matrixAutoUpdate = false;
  }

  /** In doubles: position, morphs and attachments. */
  override getVertexPosition(index: number, target: Vector3): Vector3 {
    const { skin, morphs } = this.shared;
    target.fromArray(skin.positions, 3 * index);
    if (morphs) addMorphs(morphs, skin.positions, index, this.skeleton.weights, target);
    return this.applyBoneTransform(index, target);
  }

  override applyBoneTransform(index: number, target: Vector3): Vector3;
  override applyBoneTransform(index: number, target: Vector4): Vector4;
  override applyBoneTransform(index: number, target: Vector3 | Vector4): Vector3 | Vector4 {
    const { skin, isPosed } = this.shared;
    if (!isPosed) return target;
    const isPoint = target instanceof Vector3;
    point.set(target.x, target.y, target.z, isPoint ? 1 : target.w);
    transformBy(skin.attachments, index, this.skeleton.matrices, point);
    if (target instanceof Vector3) return target.set(point.x, point.y, point.z);
    return target.copy(point);
  }
}

/** Σ wᵢ · Mᵢ · v in place, w kept as it is. A skin without attachments is bound to the root, joint 0. */
function transformBy(attachments: Attachments | undefined, vertex: number, matrices: Float64Array, v: Vector4): void {
  const { x, y, z, w } = v;
  const first = attachments ? attachments.start[vertex] : 0;
  const end = attachments ? attachments.start[vertex + 1] : 1;
  if (first === end) return;
  let sx = 0;
  let sy = 0;
  let sz = 0;
  for (let a = first; a < end; a++) {
    const m = 16 * (attachments ? attachments.joints[a] : 0);
    const weight = attachments ? attachments.weights[a] : 1;
    sx += weight * (matrices[m] * x + matrices[m + 4] * y + matrices[m + 8] * z + matrices[m + 12] * w);
    sy += weight * (matrices[m + 1] * x + matrices[m + 5] * y + matrices[m + 9] * z + matrices[m + 13] * w);
    sz += weight * (matrices[m + 2] * x + matrices[m + 6] * y + matrices[m + 10] * z + matrices[m + 14] * w);
  }
  v.set(sx, sy, sz, w);
}
