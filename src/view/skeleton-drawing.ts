/**
 * Joints of all characters together: a kind (box edges, box faces, balls, bones, axes) is one instanced mesh, so that
 * 50 characters of 70 joints cost one draw call a kind. Instance i is the same joint in every kind:
 *
 *     character 0: placement 0: joint 0 1 2 … placement 1: joint 0 1 2 …   character 1: …
 *
 * `show` after an edit decides what there is and its colours, `fill` in every frame only writes matrices.
 */
import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  CylinderGeometry,
  DynamicDrawUsage,
  GreaterDepth,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  type Material,
  MeshStandardMaterial,
  ShaderMaterial,
  SphereGeometry,
  type Vector3,
} from 'three';
import { multiplyAffine } from '../math/mat4.ts';
import { DEFAULT_DISPLAY, type Display, type Selection, type SkinStyle } from '../model/session.ts';
import type { Skeleton } from '../model/skeleton.ts';
import { dots } from './dots.ts';
import { axesMatrix, boneMatrix, boxMatrix, type JointSizes, jointSizes, sphereMatrix } from './joint-shapes.ts';
import type { StageTheme } from './theme.ts';
import { ID_FRAGMENT, lineIdMaterial, lineMaterial, rawColor, segmentsGeometry } from './thick-lines.ts';

/** A character's joints as they are to be drawn. The arrays live on: `fill` reads what they hold then. */
export interface PosedSkeleton {
  readonly characterId: string;
  readonly skeleton: Skeleton;
  /** 16 a joint, in the character's space. */
  readonly world: Float64Array;
  /** 16 a placement. */
  readonly placements: Float64Array;
  readonly hasSkin: boolean;
}

/** A skeleton with its place among the instances. */
export interface DrawnSkeleton extends PosedSkeleton {
  readonly sizes: JointSizes;
  readonly firstInstance: number;
  readonly placementCount: number;
}

/** One joint of one placement. */
export interface JointRef {
  readonly characterId: string;
  readonly placement: number;
  readonly joint: number;
}

/** Whether skins in this style hide the joints within. */
export function isOpaque(style: SkinStyle): boolean {
  return style === 'solid' || style === 'textured' || style === 'heat';
}

type KindName = 'edges' | 'faces' | 'balls' | 'bones' | 'axes';

const BOX_CORNERS = [-0.5, 0.5];

function boxEdges(): number[] {
  const points: number[] = [];
  for (const a of BOX_CORNERS) {
    for (const b of BOX_CORNERS) {
      points.push(-0.5, a, b, 0.5, a, b, a, -0.5, b, a, 0.5, b, a, b, -0.5, a, b, 0.5);
    }
  }
  return points;
}

const sizesOf = new WeakMap<Skeleton, JointSizes>();

/** `jointSizes`, once a skeleton. */
export function sizesFor(skeleton: Skeleton): JointSizes {
  let sizes = sizesOf.get(skeleton);
  if (!sizes) {
    sizes = jointSizes(skeleton);
    sizesOf.set(skeleton, sizes);
  }
  return sizes;
}

/** A kind's mesh, made anew when it has to hold more; and the same once more where something covers it, if asked. */
class Kind {
  mesh: InstancedMesh;
  /** Drawn only where it is behind something opaque: bones show through a skin. */
  covered: InstancedMesh | undefined;
  private tint: InstancedBufferAttribute | undefined;

  constructor(
    readonly geometry: BufferGeometry,
    readonly material: Material,
    readonly idMaterial: ShaderMaterial | undefined,
    private readonly tinted: boolean,
    parent: Group,
    private readonly coveredMaterial?: Material,
  ) {
    this.mesh = this.create(1);
    parent.add(this.mesh);
    this.cover();
  }

  /** Room for `count` instances. */
  resize(count: number): void {
    if (count > this.mesh.instanceMatrix.count) {
      const { parent, visible, castShadow, renderOrder } = this.mesh;
      this.mesh.removeFromParent();
      this.mesh.dispose();
      this.mesh = this.create(count);
      Object.assign(this.mesh, { visible, castShadow, renderOrder });
      parent?.add(this.mesh);
      this.cover();
    }
    this.mesh.count = count;
    if (this.covered) this.covered.count = count;
  }

  /** Colour of one instance, sRGB for tinted lines. */
  paint(instance: number, color: Color, opacity: number): void {
    if (this.tint) this.tint.setXYZW(instance, color.r, color.g, color.b, opacity);
    else this.mesh.setColorAt(instance, color);
  }

  painted(): void {
    if (this.tint) this.tint.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
    if (this.covered) this.covered.instanceColor = this.mesh.instanceColor;
  }

  get matrices(): Float32Array {
    // Made by InstancedMesh as a Float32Array; its type says any array.
    return this.mesh.instanceMatrix.array as Float32Array;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.dispose();
    this.geometry.dispose();
    this.material.dispose();
    this.idMaterial?.dispose();
    this.covered?.removeFromParent();
    this.covered?.dispose();
    this.coveredMaterial?.dispose();
  }

  /** Makes the covered mesh anew, with the arrays of the mesh. */
  private cover(): void {
    if (!this.coveredMaterial) return;
    const before = this.covered;
    before?.removeFromParent();
    before?.dispose();
    const covered = new InstancedMesh(this.geometry, this.coveredMaterial, 0);
    covered.instanceMatrix = this.mesh.instanceMatrix;
    covered.frustumCulled = false;
    covered.matrixAutoUpdate = false;
    covered.renderOrder = COVERED_ORDER;
    covered.visible = before?.visible ?? false;
    this.mesh.parent?.add(covered);
    this.covered = covered;
  }

  private create(count: number): InstancedMesh {
    const mesh = new InstancedMesh(this.geometry, this.material, count);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    // Instances are all over the place: a sphere around the unit shape says nothing.
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    if (this.tinted) {
      this.tint = new InstancedBufferAttribute(new Float32Array(4 * count), 4);
      this.geometry.setAttribute('tint', this.tint);
    }
    return mesh;
  }
}

/** How solid a joint behind a skin shows through, where it is selected. */
const MARKER_OPACITY = 0.5;
/** Likewise bones and axes that are shown under a skin. */
const COVERED_OPACITY = 0.55;
/** After all that may cover them, and before the markers. */
const COVERED_ORDER = 15;

export class SkeletonDrawing {
  readonly object = new Group();
  /** In the order of their instances. */
  drawn: readonly DrawnSkeleton[] = [];
  /** x y z of every instance's joint, in the world. */
  positions = new Float64Array(0);
  instanceCount = 0;

  private readonly kinds: Readonly<Record<KindName, Kind>>;
  private readonly axisColors: BufferGeometry;
  /** The selected joint on top of everything, in each placement. */
  private readonly markerDots = dots(1, { size: 9, depthTest: false });
  private readonly markerEdges: Kind;
  private readonly markerAxes: Kind;
  private scratch = new Float64Array(0);
  private selection: Selection = {};
  private hovered: JointRef | undefined;
  private theme: StageTheme | undefined;
  private display: Display = DEFAULT_DISPLAY;

  constructor() {
    const edges = segmentsGeometry(boxEdges());
    const axes = segmentsGeometry([0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1], new Array(9).fill(1));
    this.axisColors = axes;
    const bone = new CylinderGeometry(0.45, 1, 1, 12, 1).translate(0, 0.5, 0);
    const lit = () => new MeshStandardMaterial({ roughness: 0.62, metalness: 0 });
    const behind = { transparent: true, depthFunc: GreaterDepth, depthWrite: false } as const;
    const through = () =>
      new MeshStandardMaterial({ roughness: 0.62, metalness: 0, opacity: COVERED_OPACITY, ...behind });
    const flat = new MeshStandardMaterial({ roughness: 0.75, metalness: 0, flatShading: true });
    this.kinds = {
      edges: new Kind(
        edges,
        lineMaterial({ width: 1.25, tinted: true, lift: 2e-5 }),
        lineIdMaterial(5, 2e-5),
        true,
        this.object,
      ),
      faces: new Kind(new BoxGeometry(1, 1, 1), flat, meshIdMaterial(), false, this.object),
      balls: new Kind(new SphereGeometry(1, 16, 10), lit(), meshIdMaterial(), false, this.object, through()),
      bones: new Kind(bone, lit(), meshIdMaterial(), false, this.object, through()),
      axes: new Kind(
        axes,
        lineMaterial({ width: 1.75, segmentColors: true }),
        undefined,
        false,
        this.object,
        lineMaterial({ width: 1.75, segmentColors: true, opacity: COVERED_OPACITY }, behind),
      ),
    };
    const onTop = { depthTest: false, depthWrite: false };
    this.markerEdges = new Kind(
      segmentsGeometry(boxEdges()),
      lineMaterial({ width: 1.5, opacity: MARKER_OPACITY }, onTop),
      undefined,
      false,
      this.object,
    );
    this.markerAxes = new Kind(
      axes,
      lineMaterial({ width: 2, segmentColors: true }, onTop),
      undefined,
      false,
      this.object,
    );
    this.object.add(this.markerDots);
    this.markerEdges.mesh.renderOrder = 20;
    this.markerAxes.mesh.renderOrder = 21;
    this.markerDots.renderOrder = 22;
    this.markerDots.matrixAutoUpdate = false;
  }

  /** After an edit: which skeletons there are, what of them is drawn, and what is selected. */
  show(skeletons: readonly PosedSkeleton[], display: Display, selection: Selection, theme: StageTheme): void {
    let next = 0;
    let joints = 0;
    this.drawn = skeletons.map((posed) => {
      const placementCount = posed.placements.length / 16;
      const firstInstance = next;
      next += placementCount * posed.skeleton.joints.length;
      joints = Math.max(joints, posed.skeleton.joints.length);
      return { ...posed, sizes: sizesFor(posed.skeleton), firstInstance, placementCount };
    });
    this.instanceCount = next;
    if (this.positions.length < 3 * next) this.positions = new Float64Array(3 * next);
    if (this.scratch.length < 16 * joints) this.scratch = new Float64Array(16 * joints);
    this.selection = selection;
    this.display = display;
    if (theme !== this.theme) this.setTheme(theme);

    const { edges, faces, balls, bones, axes } = this.kinds;
    edges.mesh.visible = this.drawn.some((drawn) => this.drawsBoxes(drawn));
    faces.mesh.visible = edges.mesh.visible && display.boxes !== 'wire';
    balls.mesh.visible = bones.mesh.visible = display.bones;
    axes.mesh.visible = display.axes;
    for (const kind of Object.values(this.kinds)) {
      if (kind.mesh.visible) kind.resize(next);
      if (kind.covered) kind.covered.visible = kind.mesh.visible && this.isCovered;
      kind.mesh.castShadow = display.shadow && kind.mesh.material instanceof MeshStandardMaterial;
      kind.mesh.receiveShadow = kind.mesh.castShadow;
    }
    const markers = this.selected?.placementCount ?? 0;
    this.markerEdges.resize(markers);
    this.markerAxes.resize(markers);
    this.resizeDots(markers);
    this.markerEdges.mesh.visible = display.boxes !== 'hidden' && markers > 0;
    this.markerAxes.mesh.visible = this.markerDots.visible = markers > 0;
    this.paint();
  }

  /** Marks the joint under the pointer. Whether that changed anything. */
  hover(ref: JointRef | undefined): boolean {
    const now = this.hovered;
    if (now?.characterId === ref?.characterId && now?.placement === ref?.placement && now?.joint === ref?.joint) {
      return false;
    }
    this.hovered = ref;
    this.paint();
    return true;
  }

  /** Every frame in which a joint moved: matrices of all that is shown. Allocates nothing. */
  fill(): void {
    const { edges, faces, balls, bones, axes } = this.kinds;
    const anyBox = edges.mesh.visible || faces.mesh.visible;
    const world = this.scratch;
    const boxes = edges.mesh.visible ? edges.matrices : faces.matrices;
    for (let d = 0; d < this.drawn.length; d++) {
      const drawn = this.drawn[d];
      const { sizes, placements } = drawn;
      const joints = drawn.skeleton.joints;
      const ownBoxes = this.drawsBoxes(drawn);
      for (let p = 0; p < drawn.placementCount; p++) {
        const scale = Math.hypot(placements[16 * p], placements[16 * p + 1], placements[16 * p + 2]);
        const base = drawn.firstInstance + p * joints.length;
        for (let j = 0; j < joints.length; j++) {
          const o = 16 * j;
          const to = 16 * (base + j);
          multiplyAffine(placements, 16 * p, drawn.world, o, world, o);
          const x = world[o + 12];
          const y = world[o + 13];
          const z = world[o + 14];
          this.positions[3 * (base + j)] = x;
          this.positions[3 * (base + j) + 1] = y;
          this.positions[3 * (base + j) + 2] = z;
          if (ownBoxes) boxMatrix(world, o, joints[j].box, 1e-4 * sizes.extent, boxes, to);
          else if (anyBox) boxes.fill(0, to, to + 16);
          if (bones.mesh.visible) {
            const parent = joints[j].parent;
            sphereMatrix(x, y, z, sizes.radii[j] * scale, balls.matrices, to);
            const thick = parent < 0 ? 0 : 0.8 * Math.min(sizes.radii[parent], 1.6 * sizes.radii[j]) * scale;
            boneMatrix(world, 16 * Math.max(parent, 0), o, thick, bones.matrices, to);
          }
          if (axes.mesh.visible) axesMatrix(world, o, sizes.axis * scale, axes.matrices, to);
          if (j === this.selection.joint && drawn.characterId === this.selection.characterId) {
            sphereMatrix(x, y, z, 1, this.dotMatrices, 16 * p);
            axesMatrix(world, o, sizes.axis * scale, this.markerAxes.matrices, 16 * p);
            boxMatrix(world, o, joints[j].box, 1e-4 * sizes.extent, this.markerEdges.matrices, 16 * p);
          }
        }
      }
    }
    if (edges.mesh.visible && faces.mesh.visible)
      faces.matrices.set(edges.matrices.subarray(0, 16 * this.instanceCount));
    for (const name of KIND_NAMES) {
      if (this.kinds[name].mesh.visible) this.kinds[name].mesh.instanceMatrix.needsUpdate = true;
    }
    this.markerEdges.mesh.instanceMatrix.needsUpdate = true;
    this.markerAxes.mesh.instanceMatrix.needsUpdate = true;
    this.markerDots.instanceMatrix.needsUpdate = true;
  }

  private drawsBoxes({ hasSkin }: PosedSkeleton): boolean {
    const { boxes, skin } = this.display;
    return boxes === 'bare' ? !hasSkin || skin === 'hidden' : boxes !== 'hidden';
  }

  /** Where a joint is drawn; false where there is no such joint. Needs a `fill` after the last `show`. */
  positionOf(characterId: string, placement: number, joint: number, out: Vector3): boolean {
    const drawn = this.drawn.find((d) => d.characterId === characterId);
    if (!drawn || placement >= drawn.placementCount || joint >= drawn.skeleton.joints.length) return false;
    out.fromArray(this.positions, 3 * (drawn.firstInstance + placement * drawn.skeleton.joints.length + joint));
    return true;
  }

  /** Which joint an instance is. */
  jointAt(instance: number): JointRef | undefined {
    for (const { characterId, firstInstance, placementCount, skeleton } of this.drawn) {
      const i = instance - firstInstance;
      const count = skeleton.joints.length;
      if (i < 0 || i >= placementCount * count) continue;
      return { characterId, placement: Math.floor(i / count), joint: i % count };
    }
    return undefined;
  }

  /** The joint that a drawn bone belongs to: it leads from there to the instance's own joint. */
  boneOwner(instance: number): JointRef | undefined {
    const end = this.jointAt(instance);
    const joints = this.drawn.find((d) => d.characterId === end?.characterId)?.skeleton.joints;
    return end && joints && { ...end, joint: Math.max(0, joints[end.joint].parent) };
  }

  /**
   * Draws with ids instead of colours while `draw` runs. Balls, edges and faces are `firstId + instance`, bones
   * `firstBoneId + instance`. `wholeBoxes`: the inside of a wire box counts as the box.
   */
  withIds(firstId: number, firstBoneId: number, wholeBoxes: boolean, draw: () => void): void {
    const { edges, faces, balls, bones, axes } = this.kinds;
    const facesShown = faces.mesh.visible;
    if (edges.mesh.visible && wholeBoxes && !facesShown) {
      faces.resize(this.instanceCount);
      faces.matrices.set(edges.matrices.subarray(0, 16 * this.instanceCount));
      faces.mesh.instanceMatrix.needsUpdate = true;
      faces.mesh.visible = true;
    }
    const axesShown = axes.mesh.visible;
    const markersShown = this.markerDots.visible;
    const markerEdgesShown = this.markerEdges.mesh.visible;
    for (const { covered } of [balls, bones, axes]) if (covered) covered.visible = false;
    axes.mesh.visible = this.markerDots.visible = this.markerEdges.mesh.visible = this.markerAxes.mesh.visible = false;
    for (const kind of [edges, faces, balls, bones]) {
      if (!kind.idMaterial) continue;
      kind.idMaterial.uniforms.firstId.value = kind === bones ? firstBoneId : firstId;
      kind.mesh.material = kind.idMaterial;
    }
    try {
      draw();
    } finally {
      for (const kind of [edges, faces, balls, bones]) kind.mesh.material = kind.material;
      faces.mesh.visible = facesShown;
      axes.mesh.visible = axesShown;
      for (const { covered, mesh } of [balls, bones, axes])
        if (covered) covered.visible = mesh.visible && this.isCovered;
      this.markerDots.visible = this.markerAxes.mesh.visible = markersShown;
      this.markerEdges.mesh.visible = markerEdgesShown;
    }
  }

  /** Pixels that the lines of an ID picture spread over: its size and theirs. */
  setIdResolution(width: number, height: number): void {
    this.kinds.edges.idMaterial?.uniforms.resolution.value.set(width, height);
  }

  dispose(): void {
    for (const kind of [...Object.values(this.kinds), this.markerEdges, this.markerAxes]) kind.dispose();
    this.markerDots.geometry.dispose();
    this.markerDots.material.dispose();
    this.markerDots.dispose();
  }

  /** Whether a skin hides joints. */
  private get isCovered(): boolean {
    return isOpaque(this.display.skin) && this.drawn.some((d) => d.hasSkin);
  }

  private get selected(): DrawnSkeleton | undefined {
    const { characterId, joint } = this.selection;
    if (joint === undefined) return undefined;
    return this.drawn.find((d) => d.characterId === characterId && joint < d.skeleton.joints.length);
  }

  private get dotMatrices(): Float32Array {
    // As above.
    return this.markerDots.instanceMatrix.array as Float32Array;
  }

  private resizeDots(count: number): void {
    if (count > this.markerDots.instanceMatrix.count) {
      this.markerDots.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * count), 16);
    }
    this.markerDots.count = count;
  }

  private setTheme(theme: StageTheme): void {
    this.theme = theme;
    const colors = [theme.axisX, theme.axisY, theme.axisZ].map(rawColor);
    const attribute = this.axisColors.getAttribute('segmentColor');
    for (let v = 0; v < 12; v++) colors[Math.floor(v / 4)].toArray(attribute.array, 3 * v);
    attribute.needsUpdate = true;
    this.markerDots.material.uniforms.color.value.copy(rawColor(theme.selected));
    this.markerDots.material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
    const marker = this.markerEdges.material;
    if (marker instanceof ShaderMaterial) marker.uniforms.color.value.copy(rawColor(theme.selected));
  }

  /** Colours of all instances: what is selected, what is under the pointer, and the rest. */
  private paint(): void {
    const { theme, display } = this;
    if (!theme) return;
    const { edges, faces, balls, bones } = this.kinds;
    const line = rawColor(theme.boxEdge);
    // Edges of solid boxes only help to tell their faces apart.
    // And where a skin covers them, what sticks out of it is beside the point.
    const opacity = theme.boxEdgeOpacity * (display.boxes === 'solid' || this.isCovered ? 0.5 : 1);
    const colors = {
      box: new Color(theme.box),
      bone: new Color(theme.bone),
      selected: new Color(theme.selected),
      hovered: new Color(theme.hovered),
      selectedLine: rawColor(theme.selected),
      hoveredLine: rawColor(theme.hovered),
    };
    for (const { characterId, firstInstance, placementCount, skeleton } of this.drawn) {
      const joints = skeleton.joints;
      const chosen = characterId === this.selection.characterId ? this.selection.joint : undefined;
      for (let p = 0; p < placementCount; p++) {
        const { hovered } = this;
        const under = hovered?.characterId === characterId && hovered.placement === p ? hovered.joint : undefined;
        for (let j = 0; j < joints.length; j++) {
          const i = firstInstance + p * joints.length + j;
          const mark = j === chosen ? 'selected' : j === under ? 'hovered' : undefined;
          const { parent } = joints[j];
          const boneMark =
            parent < 0 ? undefined : parent === chosen ? 'selected' : parent === under ? 'hovered' : undefined;
          if (edges.mesh.visible) {
            edges.paint(i, mark ? colors[`${mark}Line`] : line, mark ? 1 : opacity);
          }
          if (faces.mesh.visible) faces.paint(i, colors[mark ?? 'box'], 1);
          if (balls.mesh.visible) {
            balls.paint(i, colors[mark ?? 'bone'], 1);
            bones.paint(i, colors[boneMark ?? 'bone'], 1);
          }
        }
      }
    }
    for (const kind of [edges, faces, balls, bones]) kind.painted();
  }
}

const KIND_NAMES: readonly KindName[] = ['edges', 'faces', 'balls', 'bones', 'axes'];

/** Ids `firstId + instance` of instanced meshes. */
function meshIdMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    toneMapped: false,
    uniforms: { firstId: { value: 0 } },
    vertexShader: /* glsl */ `
      uniform float firstId;
      flat varying highp uint vId;
      void main() {
        vId = uint(firstId) + uint(gl_InstanceID);
        gl_Position = projectionMatrix * (modelViewMatrix * (instanceMatrix * vec4(position, 1.0)));
      }
    `,
    fragmentShader: ID_FRAGMENT,
  });
}
