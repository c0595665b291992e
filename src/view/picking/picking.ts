/**
 * Picking by drawing ids instead of colours into a few pixels around the pointer and reading them back: as exact as the
 * rendering itself (skinning, morphs, hidden parts), without intersecting a million triangles.
 *
 *     joints   edges, faces, balls: one id per joint; bones: one id each, meaning the joint where they start
 *     skins    one id per vertex: a triangle has the id of its last vertex (the provoking vertex of flat shading)
 *
 * The triangle is found among those that end in that vertex, and its corner nearest the pointer is picked. Rejected:
 * drawing all vertices as points. A coarse skin has none near the pointer, and a fine one would draw a million more.
 */
import {
  type Camera,
  DoubleSide,
  NearestFilter,
  type OrthographicCamera,
  type PerspectiveCamera,
  ShaderMaterial,
  Vector3,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import type { Skin } from '../../model/skin.ts';
import { ID_FRAGMENT } from '../scene/thick-lines.ts';
import type { JointRef } from '../skeleton/drawn-skeletons.ts';
import type { SkeletonDrawing } from '../skeleton/skeleton-drawing.ts';
import type { SkinMaterials } from '../skin/skin-materials.ts';
import type { MarrowSkinnedMesh } from '../skin/skinned-mesh.ts';
import { placeOne, withExactSkinning } from '../skin/skinning.ts';
import { IdRuns, nearestId } from './pick-ids.ts';

/** What was hit; indices are into the character's own lists. */
export interface Hit {
  readonly characterId: string;
  readonly placement: number;
  /** For a hit on the skin: the joint with the largest weight on the vertex. */
  readonly joint?: number;
  readonly vertex?: number;
}

/** A skin as it is drawn at one placement. */
export interface PickableSkin {
  readonly characterId: string;
  readonly placement: number;
  readonly mesh: MarrowSkinnedMesh;
}

export interface PickScene {
  readonly camera: PerspectiveCamera | OrthographicCamera;
  /** CSS pixels of the viewport. */
  readonly width: number;
  readonly height: number;
  readonly skeletons: SkeletonDrawing;
  readonly skins: readonly PickableSkin[];
  /** Whether skins hide the joints inside; otherwise joints are picked through them. */
  readonly skinsAreOpaque: boolean;
}

/** Side of the picking image in CSS pixels: the pointer's, and this many on each side. */
const SLACK = 7;
const SIZE = 2 * SLACK + 1;
/** Hit tolerance for lines and small balls, CSS pixels. */
const JOINT_REACH = 5;
const SKIN_REACH = 4;

type Pickable =
  | { readonly kind: 'joints' }
  | { readonly kind: 'bones' }
  | { readonly kind: 'skin'; readonly skin: PickableSkin };

export class Picker {
  private readonly target = new WebGLRenderTarget(SIZE, SIZE, {
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    generateMipmaps: false,
  });
  private readonly pixels = new Uint8Array(4 * SIZE * SIZE);
  private readonly runs = new IdRuns<Pickable>();
  /** One per skin with textures of its own, one for all others. */
  private readonly materials = new Map<SkinMaterials, ShaderMaterial>();

  constructor(private readonly renderer: WebGLRenderer) {}

  /** @param x, y CSS pixels from the viewport's top left */
  pick(scene: PickScene, x: number, y: number): Hit | undefined {
    if (scene.skinsAreOpaque) {
      this.draw(scene, x, y, true, true);
      return this.jointHit(scene) ?? this.skinHit(scene, x, y);
    }
    const joint = this.pickJoint(scene, x, y);
    if (joint || scene.skins.length === 0) return joint;
    this.draw(scene, x, y, false, true);
    return this.skinHit(scene, x, y);
  }

  /** Only joints, and skins that hide them: cheap enough for every pointer move. */
  pickJoint(scene: PickScene, x: number, y: number): JointRef | undefined {
    this.draw(scene, x, y, true, scene.skinsAreOpaque);
    return this.jointHit(scene);
  }

  dispose(): void {
    this.target.dispose();
    for (const material of this.materials.values()) material.dispose();
  }

  /** Draws ids around the pointer and reads them back into `pixels`. */
  private draw(scene: PickScene, x: number, y: number, joints: boolean, skins: boolean): void {
    const { renderer, runs } = this;
    const { camera, width, height, skeletons } = scene;
    const before = renderer.getRenderTarget();
    const autoClear = renderer.autoClear;
    const clearAlpha = renderer.getClearAlpha();
    runs.clear();
    camera.setViewOffset(width, height, x - SIZE / 2, y - SIZE / 2, SIZE, SIZE);
    renderer.setRenderTarget(this.target);
    renderer.setClearAlpha(0);
    renderer.autoClear = false;
    renderer.clear();
    try {
      if (skins) for (const skin of scene.skins) this.drawSkin(skin, camera);
      if (joints && skeletons.instanceCount > 0) {
        const firstJoint = runs.add(skeletons.instanceCount, { kind: 'joints' });
        const firstBone = runs.add(skeletons.instanceCount, { kind: 'bones' });
        skeletons.setIdResolution(SIZE, SIZE);
        skeletons.withIds(firstJoint, firstBone, !scene.skinsAreOpaque, () =>
          renderer.render(skeletons.object, camera),
        );
      }
      renderer.readRenderTargetPixels(this.target, 0, 0, SIZE, SIZE, this.pixels);
    } finally {
      renderer.setRenderTarget(before);
      renderer.setClearAlpha(clearAlpha);
      renderer.autoClear = autoClear;
      camera.clearViewOffset();
    }
  }

  /** Draws the mesh in another material and restores its own. */
  private drawSkin(skin: PickableSkin, camera: Camera): void {
    const { mesh } = skin;
    const material = this.materialFor(mesh);
    const { material: own } = mesh;
    material.uniforms.firstId.value = this.runs.add(mesh.geometry.attributes.position.count, { kind: 'skin', skin });
    placeOne(material, mesh.skeleton);
    mesh.material = material;
    this.renderer.render(mesh, camera);
    mesh.material = own;
  }

  private materialFor({ shared }: MarrowSkinnedMesh): ShaderMaterial {
    const key = shared.materials;
    let material = this.materials.get(key);
    if (!material) {
      material = withExactSkinning(skinIdMaterial(), shared, { placing: 'one' });
      this.materials.set(key, material);
      shared.geometry.addEventListener('dispose', () => {
        this.materials.get(key)?.dispose();
        this.materials.delete(key);
      });
    }
    return material;
  }

  private jointHit({ skeletons }: PickScene): JointRef | undefined {
    const id = nearestId(this.pixels, SIZE, JOINT_REACH, (i) => this.runs.find(i)?.what.kind !== 'skin');
    const run = this.runs.find(id);
    if (!run) return undefined;
    const instance = id - run.first;
    return run.what.kind === 'bones' ? skeletons.boneOwner(instance) : skeletons.jointAt(instance);
  }

  private skinHit(scene: PickScene, x: number, y: number): Hit | undefined {
    const id = nearestId(this.pixels, SIZE, SKIN_REACH, (i) => this.runs.find(i)?.what.kind === 'skin');
    const run = this.runs.find(id);
    if (run?.what.kind !== 'skin') return undefined;
    const { characterId, placement, mesh } = run.what.skin;
    const at = new Vector3((2 * x) / scene.width - 1, 1 - (2 * y) / scene.height, 0);
    const vertex = nearestCorner(mesh, id - run.first, scene.camera, scene.width / scene.height, at);
    const joint = heaviestJoint(mesh.shared.skin, vertex);
    return { characterId, placement, vertex, ...(joint === undefined ? {} : { joint }) };
  }
}

/** The joint with the largest weight on a vertex, the first if equal; undefined without weights. */
export function heaviestJoint({ attachments }: Skin, vertex: number): number | undefined {
  if (!attachments) return 0;
  let best: number | undefined;
  let most = 0;
  for (let a = attachments.start[vertex]; a < attachments.start[vertex + 1]; a++) {
    if (attachments.weights[a] <= most) continue;
    most = attachments.weights[a];
    best = attachments.joints[a];
  }
  return best;
}

/** Triangles that end in this vertex, as indices of their first corner in `triangles`. */
export function trianglesEndingIn(triangles: ArrayLike<number>, vertex: number): number[] {
  const found: number[] = [];
  for (let t = 2; t < triangles.length; t += 3) if (triangles[t] === vertex) found.push(t - 2);
  return found;
}

/**
 * Of the triangles that end in `last`, the one under the pointer (or nearest to it), and of its corners the one nearest
 * to the pointer on screen. `at` is the pointer in −1 … 1.
 */
function nearestCorner(mesh: MarrowSkinnedMesh, last: number, camera: Camera, aspect: number, at: Vector3): number {
  const { triangles } = mesh.shared.skin;
  const corners = [new Vector3(), new Vector3(), new Vector3()];
  let best = last;
  let bestOutside = Infinity;
  let bestDepth = Infinity;
  for (const t of trianglesEndingIn(triangles, last)) {
    for (let k = 0; k < 3; k++) {
      mesh.getVertexPosition(triangles[t + k], corners[k]);
      corners[k].applyMatrix4(mesh.matrixWorld).project(camera).sub(at);
      corners[k].x *= aspect;
    }
    const outside = distanceToTriangle(corners);
    const depth = corners[0].z + corners[1].z + corners[2].z;
    if (outside > bestOutside || (outside === bestOutside && depth >= bestDepth)) continue;
    bestOutside = outside;
    bestDepth = depth;
    const distances = corners.map((c) => Math.hypot(c.x, c.y));
    best = triangles[t + distances.indexOf(Math.min(...distances))];
  }
  return best;
}

/** Distance from the origin to a triangle in the plane, either winding; 0 inside. */
function distanceToTriangle([a, b, c]: readonly Vector3[]): number {
  const side = (p: Vector3, q: Vector3) => p.x * q.y - p.y * q.x;
  const s = [side(a, b), side(b, c), side(c, a)];
  if (s.every((v) => v >= 0) || s.every((v) => v <= 0)) return 0;
  return Math.min(toSegment(a, b), toSegment(b, c), toSegment(c, a));
}

/** Distance from the origin to a segment in the plane. */
function toSegment(p: Vector3, q: Vector3): number {
  const dx = q.x - p.x;
  const dy = q.y - p.y;
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.min(1, Math.max(0, -(p.x * dx + p.y * dy) / length2)) : 0;
  return Math.hypot(p.x + t * dx, p.y + t * dy);
}

function skinIdMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    // Real files have any winding.
    side: DoubleSide,
    toneMapped: false,
    uniforms: { firstId: { value: 1 } },
    vertexShader: /* glsl */ `
      #include <common>
      #include <morphtarget_pars_vertex>
      #include <skinning_pars_vertex>
      uniform highp uint firstId;
      flat varying highp uint vId;
      void main() {
        #include <skinbase_vertex>
        #include <begin_vertex>
        #include <morphtarget_vertex>
        #include <skinning_vertex>
        #include <project_vertex>
        vId = firstId + uint(gl_VertexID);
      }
    `,
    fragmentShader: ID_FRAGMENT,
  });
}
