/**
 * Joints of all characters together: each kind (box edges, box faces, balls, bones, axes) is one instanced mesh, so
 * that 50 characters of 70 joints cost one draw call per kind. Instance i is the same joint or End Site in every kind:
 * see `drawn-skeletons.ts`.
 *
 * `show` after an edit sets instances and colours; `fill` every frame only writes matrices.
 */
import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  GreaterDepth,
  Group,
  MeshStandardMaterial,
  Vector2,
  type Vector3,
} from 'three';
import { axesMatrix, boxMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import {
  DEFAULT_DISPLAY,
  type Display,
  NOTHING_SELECTED,
  type Selection,
  type SkinStyle,
} from '../../model/session.ts';
import { areBoxesOversized, areBoxesPlain, hasAllBoxes, hasBox, hasBoxes } from '../../model/skeleton/boxes.ts';
import { jointsIn, partOf } from '../../model/skeleton/selected-joints.ts';
import { lineIdMaterial, lineMaterial, rawColor, segmentsGeometry } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';
import { ballGeometry, boneGeometry, LEVELS, levelFor } from './bone-levels.ts';
import {
  assignInstances,
  boneOwner,
  type DrawnSkeleton,
  instanceOf,
  instancesOf,
  type JointRef,
  jointAt,
  ownerOf,
  type PosedSkeleton,
  posedNodes,
} from './drawn-skeletons.ts';
import { InstancedKind, meshIdMaterial } from './instanced-kind.ts';
import { JointMarkers, paintAxes } from './joint-markers.ts';
import { drawnByNodes, NODE_STRIDE, NodeBuffer, type NodeShape, setNodeThickness } from './node-buffer.ts';
import { fillNodes, hideMissing, placementScale, placeNodes, placePositions } from './node-matrices.ts';

/** Whether skins in this style hide the joints inside. */
export function isOpaque(style: SkinStyle): boolean {
  return style === 'solid' || style === 'textured' || style === 'heat' || style === 'four';
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

/** Opacity of bones and axes shown through a skin. */
const COVERED_OPACITY = 0.55;

/** The selected joints of a skeleton, without the active one. */
interface OtherJoints {
  readonly joints: readonly number[];
  /** Index of the dot of the first one. */
  readonly first: number;
}

export class SkeletonDrawing {
  readonly object = new Group();
  /** In the order of their instances. */
  drawn: readonly DrawnSkeleton[] = [];
  /** x y z of every instance's joint or End Site, in the world. */
  positions = new Float64Array(0);
  instanceCount = 0;

  private readonly kinds: Readonly<Record<KindName, InstancedKind>>;
  private readonly idResolution = { value: new Vector2(1, 1) };
  /** Of balls and bones. */
  private readonly nodes = new NodeBuffer();
  private readonly markers: JointMarkers;
  private readonly axisColors: BufferGeometry;
  /** Per entry of `drawn`: whether boxes and bones are shown. Cached, since every frame asks. */
  private withBoxes: readonly boolean[] = [];
  private withBones: readonly boolean[] = [];
  private scratch = new Float64Array(0);
  private selection: Selection = {};
  /** Per entry of `drawn`. */
  private others: readonly OtherJoints[] = [];
  private hovered: JointRef | undefined;
  private theme: StageTheme | undefined;
  private display: Display = DEFAULT_DISPLAY;

  constructor() {
    const { object } = this;
    const edges = segmentsGeometry(boxEdges());
    const axes = segmentsGeometry([0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1], new Array(9).fill(1));
    this.axisColors = axes;
    const lit = (shape: NodeShape) => drawnByNodes(new MeshStandardMaterial({ roughness: 0.62, metalness: 0 }), shape);
    const behind = { transparent: true, depthFunc: GreaterDepth, depthWrite: false } as const;
    const through = (shape: NodeShape) => {
      const material = { roughness: 0.62, metalness: 0, opacity: COVERED_OPACITY, ...behind };
      return drawnByNodes(new MeshStandardMaterial(material), shape);
    };
    const flat = new MeshStandardMaterial({ roughness: 0.75, metalness: 0, flatShading: true });
    const edgeLines = lineMaterial({ width: 1.25, tinted: true, lift: 2e-5 });
    const axisLines = { width: 1.75, segmentColors: true };
    const axesThrough = lineMaterial({ ...axisLines, opacity: COVERED_OPACITY }, behind);
    const ids = meshIdMaterial;
    const ofNodes = (shape: NodeShape, [geometry, ...lighter]: readonly BufferGeometry[]) => {
      const idMaterial = drawnByNodes(ids(), shape, this.idResolution);
      const more = { coveredMaterial: through(shape), lighter, shape };
      return new InstancedKind(geometry, lit(shape), idMaterial, false, object, more);
    };
    this.kinds = {
      edges: new InstancedKind(edges, edgeLines, lineIdMaterial(5, 2e-5), true, object),
      faces: new InstancedKind(new BoxGeometry(1, 1, 1), flat, ids(), false, object),
      balls: ofNodes('ball', LEVELS.map(ballGeometry)),
      bones: ofNodes('bone', LEVELS.map(boneGeometry)),
      axes: new InstancedKind(axes, lineMaterial(axisLines), undefined, false, object, {
        coveredMaterial: axesThrough,
      }),
    };
    this.markers = new JointMarkers(object, segmentsGeometry(boxEdges()), axes);
  }

  /** Call after an edit: sets which skeletons there are, what is drawn of them, and what is selected. */
  show(skeletons: readonly PosedSkeleton[], display: Display, selection: Selection, theme: StageTheme): void {
    this.drawn = assignInstances(skeletons);
    this.instanceCount = instancesOf(this.drawn);
    const most = this.drawn.reduce((nodes, d) => Math.max(nodes, d.nodes.count), 0);
    if (this.positions.length < 3 * this.instanceCount) this.positions = new Float64Array(3 * this.instanceCount);
    if (this.scratch.length < 16 * most) this.scratch = new Float64Array(16 * most);
    this.selection = selection;
    this.display = display;
    setNodeThickness(display.boneThickness);
    if (theme !== this.theme) this.setTheme(theme);

    const { edges, faces, balls, bones, axes } = this.kinds;
    this.withBoxes = this.drawn.map((drawn) => this.drawsBoxes(drawn));
    this.withBones = this.drawn.map((drawn) => this.drawsBones(drawn));
    edges.mesh.visible = this.withBoxes.includes(true);
    faces.mesh.visible = edges.mesh.visible && display.boxes !== 'wire';
    balls.mesh.visible = bones.mesh.visible = this.withBones.includes(true);
    axes.mesh.visible = display.axes;
    const level = levelFor(this.instanceCount);
    for (const kind of [balls, bones]) kind.setLevel(level);
    if (balls.mesh.visible) this.nodes.resize(this.instanceCount, [...balls.geometries, ...bones.geometries]);
    for (const kind of Object.values(this.kinds)) {
      if (kind.mesh.visible) kind.resize(this.instanceCount);
      if (kind.covered) kind.covered.visible = kind.mesh.visible && this.isCovered;
      kind.mesh.receiveShadow = display.shadow && kind.mesh.material instanceof MeshStandardMaterial;
      // The balls' part of the shadow isn't noticeable.
      kind.mesh.castShadow = kind.mesh.receiveShadow && !(level > 0 && kind === balls);
    }
    let dots = 0;
    this.others = this.drawn.map(({ characterId, nodes, placementCount }) => {
      const { joint } = characterId === selection.characterId ? selection : NOTHING_SELECTED;
      const all = jointsIn(partOf(selection, characterId) ?? NOTHING_SELECTED);
      const joints = all.filter((one) => one !== joint && one < nodes.jointCount);
      const first = dots;
      dots += joints.length * placementCount;
      return { joints, first };
    });
    this.markers.show(this.selected?.placementCount ?? 0, display.boxes !== 'hidden', dots);
    this.paint();
  }

  /** Highlights the joint under the pointer. Returns whether that changed anything. */
  hover(ref: JointRef | undefined): boolean {
    const now = this.hovered;
    if (now?.characterId === ref?.characterId && now?.placement === ref?.placement && now?.joint === ref?.joint) {
      return false;
    }
    this.hovered = ref;
    this.paint();
    return true;
  }

  /** Call every frame in which a joint moved: writes all matrices. Allocates nothing. */
  fill(): void {
    const { edges, faces, balls } = this.kinds;
    for (let d = 0; d < this.drawn.length; d++) {
      for (let p = 0; p < this.drawn[d].placementCount; p++) this.fillPlacement(d, p);
    }
    if (edges.mesh.visible && faces.mesh.visible)
      faces.matrices.set(edges.matrices.subarray(0, 16 * this.instanceCount));
    for (const name of WITH_MATRICES) {
      if (this.kinds[name].mesh.visible) this.kinds[name].mesh.instanceMatrix.needsUpdate = true;
    }
    if (balls.mesh.visible) this.nodes.filled();
    this.markers.filled();
  }

  private fillPlacement(d: number, p: number): void {
    const drawn = this.drawn[d];
    const drawsBoxes = this.withBoxes[d];
    const { edges, faces, balls, axes } = this.kinds;
    const { sizes, placements, nodes, skeleton, firstInstance } = drawn;
    const { positions, scratch: world, selection } = this;
    const { joints } = skeleton;
    const { count, jointCount } = nodes;
    const first = firstInstance + p * count;
    const scale = placementScale(placements, 16 * p);
    const { joint } = selection;
    const isMarked = joint !== undefined && joint < jointCount && drawn.characterId === selection.characterId;
    // Balls and bones need positions only, everything else orientations too.
    placePositions(posedNodes(nodes, drawn.skeleton, drawn.dofs), placements, 16 * p, drawn.world, positions, first);
    if (drawsBoxes || isMarked || axes.mesh.visible) placeNodes(nodes, placements, 16 * p, drawn.world, world);
    if (balls.mesh.visible) {
      const { values } = this.nodes;
      if (this.withBones[d]) fillNodes(nodes, sizes, scale, positions, values, first);
      else values.fill(0, NODE_STRIDE * first, NODE_STRIDE * (first + count));
    }
    const { missing, dofs } = drawn;
    if (missing) hideMissing(skeleton, dofs, missing, balls.mesh.visible ? this.nodes.values : undefined, first);
    if (edges.mesh.visible || faces.mesh.visible) {
      const boxes = edges.mesh.visible ? edges.matrices : faces.matrices;
      boxes.fill(0, 16 * first, 16 * (first + count));
      if (drawsBoxes) {
        for (let j = 0; j < jointCount; j++) {
          if (hasBox(joints[j])) boxMatrix(world, 16 * j, joints[j].box, 1e-4 * sizes.extent, boxes, 16 * (first + j));
        }
      }
    }
    if (axes.mesh.visible) {
      const { matrices } = axes;
      for (let j = 0; j < jointCount; j++) axesMatrix(world, 16 * j, sizes.axis * scale, matrices, 16 * (first + j));
      matrices.fill(0, 16 * (first + jointCount), 16 * (first + count));
    }
    if (isMarked) {
      if (missing?.[joint]) this.markers.hide(p);
      else this.markers.fill(p, joints[joint], sizes, scale, world, 16 * joint);
    }
    const others = this.others[d];
    for (let k = 0; k < others.joints.length; k++) {
      const other = others.joints[k];
      const o = 3 * (first + other);
      const slot = others.first + p * others.joints.length + k;
      if (missing?.[other]) this.markers.hideOther(slot);
      else this.markers.fillOther(slot, positions[o], positions[o + 1], positions[o + 2]);
    }
  }

  /** World position of a joint as drawn; false if there is no such joint. Needs a `fill` after the last `show`. */
  positionOf(characterId: string, placement: number, joint: number, out: Vector3): boolean {
    const instance = instanceOf(this.drawn, characterId, placement, joint);
    if (instance < 0) return false;
    out.fromArray(this.positions, 3 * instance);
    return true;
  }

  /** Whether the boxes of `drawn[d]` are drawn with faces. An arrow function, since it is passed on. */
  readonly hasSolidBoxes = (d: number): boolean => this.withBoxes[d] && this.kinds.faces.mesh.visible;

  /** The joint of an instance; for an End Site, the one that it ends. */
  jointAt(instance: number): JointRef | undefined {
    return jointAt(this.drawn, instance);
  }

  /** The joint where the bone of an instance starts. */
  boneOwner(instance: number): JointRef | undefined {
    return boneOwner(this.drawn, instance);
  }

  /**
   * Draws ids instead of colours while `draw` runs. Balls, edges and faces are `firstId + instance`, bones `firstBoneId
   * + instance`. `wholeBoxes`: the inside of a wire box counts as the box.
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
    for (const { covered } of [balls, bones, axes]) if (covered) covered.visible = false;
    axes.mesh.visible = false;
    for (const kind of [edges, faces, balls, bones]) {
      if (!kind.idMaterial) continue;
      kind.idMaterial.uniforms.firstId.value = kind === bones ? firstBoneId : firstId;
      kind.mesh.material = kind.idMaterial;
    }
    try {
      this.markers.without(draw);
    } finally {
      for (const kind of [edges, faces, balls, bones]) kind.mesh.material = kind.material;
      faces.mesh.visible = facesShown;
      axes.mesh.visible = axesShown;
      for (const { covered, mesh } of [balls, bones, axes])
        if (covered) covered.visible = mesh.visible && this.isCovered;
    }
  }

  /** Sets the resolution by which lines of the ID image compute their width, in pixels. */
  setIdResolution(width: number, height: number): void {
    this.kinds.edges.idMaterial?.uniforms.resolution.value.set(width, height);
    this.idResolution.value.set(width, height);
  }

  dispose(): void {
    for (const kind of Object.values(this.kinds)) kind.dispose();
    this.markers.dispose();
  }

  private asksForBoxes({ hasSkin }: PosedSkeleton): boolean {
    const { boxes, skin } = this.display;
    return boxes === 'bare' ? !hasSkin || skin === 'hidden' : boxes !== 'hidden';
  }

  private drawsBoxes(drawn: PosedSkeleton): boolean {
    return !drawn.withBones && this.asksForBoxes(drawn) && hasBoxes(drawn.skeleton) && !this.prefersBones(drawn);
  }

  /** Unless boxes were asked for, those that hide the skeleton aren't drawn. */
  private prefersBones({ skeleton }: PosedSkeleton): boolean {
    return this.display.boxes === 'bare' && areBoxesOversized(skeleton);
  }

  /** With boxes on, bones are still drawn if a joint has no box, or most boxes are default cubes. */
  private drawsBones(drawn: PosedSkeleton): boolean {
    if (this.display.bones || drawn.withBones) return true;
    const { skeleton } = drawn;
    if (!this.asksForBoxes(drawn)) return false;
    return this.prefersBones(drawn) || !hasAllBoxes(skeleton) || (!drawn.hasSkin && areBoxesPlain(skeleton));
  }

  /** Whether a skin hides joints. */
  private get isCovered(): boolean {
    return isOpaque(this.display.skin) && this.drawn.some((d) => d.hasSkin);
  }

  private get selected(): DrawnSkeleton | undefined {
    const { characterId, joint } = this.selection;
    if (joint === undefined) return undefined;
    return this.drawn.find((d) => d.characterId === characterId && joint < d.nodes.jointCount);
  }

  private setTheme(theme: StageTheme): void {
    this.theme = theme;
    paintAxes(this.axisColors, theme);
    this.markers.setTheme(theme);
  }

  /** Sets the colours of all instances: active, selected, hovered, and others. */
  private paint(): void {
    const { theme, display, hovered, selection } = this;
    if (!theme) return;
    const { edges, faces, balls, bones } = this.kinds;
    const line = rawColor(theme.boxEdge);
    // Edges of solid boxes only separate their faces; edges sticking out of a skin are secondary.
    const opacity = theme.boxEdgeOpacity * (display.boxes === 'solid' || this.isCovered ? 0.5 : 1);
    const colors = {
      box: new Color(theme.box),
      bone: new Color(theme.bone),
      selected: new Color(theme.selected),
      selectedToo: new Color(theme.selectedToo),
      hovered: new Color(theme.hovered),
      comparedFirst: new Color(theme.comparedFirst),
      comparedSecond: new Color(theme.comparedSecond),
      selectedLine: rawColor(theme.selected),
      selectedTooLine: rawColor(theme.selectedToo),
      hoveredLine: rawColor(theme.hovered),
    };
    this.drawn.forEach((drawn, d) => {
      const { characterId, firstInstance, placementCount, nodes, tint } = drawn;
      const ownLine = tint ? rawColor(theme[tint]) : line;
      const active = characterId === selection.characterId ? selection.joint : undefined;
      const others = new Set(this.others[d].joints);
      for (let p = 0; p < placementCount; p++) {
        const under = hovered?.characterId === characterId && hovered.placement === p ? hovered.joint : undefined;
        const markOf = (joint: number) => {
          if (joint === active) return 'selected';
          if (joint === under) return 'hovered';
          return others.has(joint) ? 'selectedToo' : undefined;
        };
        for (let n = 0; n < nodes.count; n++) {
          const i = firstInstance + p * nodes.count + n;
          const mark = n < nodes.jointCount ? markOf(n) : undefined;
          if (edges.mesh.visible) edges.paint(i, mark ? colors[`${mark}Line`] : ownLine, mark ? 1 : opacity);
          if (faces.mesh.visible) faces.paint(i, colors[mark ?? tint ?? 'box'], 1);
          if (!balls.mesh.visible) continue;
          const boneMark = n === 0 ? undefined : markOf(ownerOf(drawn, n));
          // The ball of an End Site is coloured like its bone.
          balls.paint(i, colors[(n < nodes.jointCount ? mark : boneMark) ?? tint ?? 'bone'], 1);
          bones.paint(i, colors[boneMark ?? tint ?? 'bone'], 1);
        }
      }
    });
    for (const kind of [edges, faces, balls, bones]) kind.painted();
  }
}

/** Balls and bones have a `NodeBuffer`. */
const WITH_MATRICES: readonly KindName[] = ['edges', 'faces', 'axes'];
