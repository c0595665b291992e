/**
 * Bones of rig mode: octahedra, thick near the start, so that their direction is visible. Unlit and drawn over
 * everything, since they show where joints are inside a skin.
 */
import { BufferAttribute, BufferGeometry, Color, type Group, MeshBasicMaterial } from 'three';
import { boneMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import { lineMaterial, rawColor, segmentsGeometry } from '../scene/thick-lines.ts';
import { InstancedKind } from '../skeleton/instanced-kind.ts';
import type { StageTheme } from '../theme.ts';

/** Position along the bone where it is thickest. */
const WAIST = 0.14;
/** Thickness, as a part of its length, and its maximum in CSS pixels. */
const SHARE = 0.09;
const MAX_PIXELS = 9;

const CORNERS = [
  [1, WAIST, 0],
  [0, WAIST, 1],
  [-1, WAIST, 0],
  [0, WAIST, -1],
] as const;

function faces(): BufferGeometry {
  const geometry = new BufferGeometry();
  const points = [0, 0, 0, 0, 1, 0, ...CORNERS.flat()];
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  const index = CORNERS.flatMap((_, i) => {
    const [a, b] = [2 + i, 2 + ((i + 1) % 4)];
    return [0, a, b, 1, b, a];
  });
  geometry.setIndex(index);
  return geometry;
}

function edges(): number[] {
  return CORNERS.flatMap((corner, i) => [
    ...[0, 0, 0, ...corner],
    ...[0, 1, 0, ...corner],
    ...corner,
    ...CORNERS[(i + 1) % 4],
  ]);
}

export class BoneShapes {
  private readonly faces: InstancedKind;
  private readonly edges: InstancedKind;
  private readonly colors = { usual: new Color(), selected: new Color(), selectedToo: new Color() };
  private readonly lines = { usual: new Color(), selected: new Color(), selectedToo: new Color(), hot: new Color() };

  constructor(parent: Group) {
    const onTop = { depthTest: false, depthWrite: false };
    const fill = new MeshBasicMaterial({ ...onTop, toneMapped: false, transparent: true, opacity: 0.34 });
    this.faces = new InstancedKind(faces(), fill, undefined, false, parent);
    this.edges = new InstancedKind(
      segmentsGeometry(edges()),
      lineMaterial({ width: 1.25, tinted: true }, onTop),
      undefined,
      true,
      parent,
    );
  }

  resize(count: number): void {
    for (const kind of [this.faces, this.edges]) {
      kind.resize(count);
      kind.mesh.renderOrder = kind === this.faces ? 40 : 41;
    }
  }

  /**
   * Sets instance `i` to run from one node of `world` to another (node indices).
   *
   * @param perPixel world length of a CSS pixel there
   */
  place(i: number, world: Float64Array, from: number, to: number, perPixel: number): void {
    const [a, b] = [16 * from + 12, 16 * to + 12];
    const dx = world[b] - world[a];
    const dy = world[b + 1] - world[a + 1];
    const dz = world[b + 2] - world[a + 2];
    const thick = Math.min(SHARE * Math.sqrt(dx * dx + dy * dy + dz * dz), MAX_PIXELS * perPixel);
    boneMatrix(world, 16 * from, 16 * to, thick, this.faces.matrices, 16 * i);
    this.edges.matrices.set(this.faces.matrices.subarray(16 * i, 16 * i + 16), 16 * i);
  }

  hide(i: number): void {
    for (const kind of [this.faces, this.edges]) kind.matrices.fill(0, 16 * i, 16 * i + 16);
  }

  paint(i: number, look: 'usual' | 'selected' | 'selectedToo' | 'hot'): void {
    this.faces.paint(i, look === 'hot' ? this.colors.usual : this.colors[look], 1);
    this.edges.paint(i, this.lines[look], look === 'usual' ? 0.8 : 1);
  }

  painted(): void {
    for (const kind of [this.faces, this.edges]) kind.painted();
  }

  filled(): void {
    for (const kind of [this.faces, this.edges]) kind.mesh.instanceMatrix.needsUpdate = true;
  }

  setTheme(theme: StageTheme): void {
    this.colors.usual.set(theme.bone);
    this.colors.selected.set(theme.selected);
    this.colors.selectedToo.set(theme.selectedToo);
    this.lines.usual.copy(rawColor(theme.boxEdge));
    this.lines.selected.copy(rawColor(theme.selected));
    this.lines.selectedToo.copy(rawColor(theme.selectedToo));
    this.lines.hot.copy(rawColor(theme.hovered));
  }

  dispose(): void {
    this.faces.dispose();
    this.edges.dispose();
  }
}
