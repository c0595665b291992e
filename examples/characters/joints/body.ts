/** The exhibits' mesh: static steps, plinths and rods, and a moving piece on each joint. */

import { add, cross, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { Atlas, blend, type Colour, colour } from '../paint/atlas.ts';
import { along, around, MeshBuilder, type Rect, type Weights } from '../shape/mesh.ts';
import { normalise } from '../shape/vectors.ts';
import { type Family, type Piece, PLACED, PLINTH, ROWS, STEP_DEPTH, STEP_HEIGHT, WIDTH } from './exhibits.ts';

const ATLAS_SIZE = 128;
const TILE = 28;
/** By columns and rows of tiles. */
const tile = (column: number, row: number): Rect => [2 + 32 * column, 2 + 32 * row, TILE, TILE];
/** Side and front tiles of moving pieces, by family. */
const FACES: Readonly<Record<Family, { readonly side: Rect; readonly front: Rect; readonly colour: Colour }>> = {
  turn: { side: tile(0, 0), front: tile(1, 0), colour: colour('#5b7fd6') },
  slide: { side: tile(2, 0), front: tile(3, 0), colour: colour('#2f9d8f') },
  mix: { side: tile(0, 1), front: tile(1, 1), colour: colour('#e0a030') },
  stretch: { side: tile(2, 1), front: tile(3, 1), colour: colour('#d9644f') },
};
const STEP = tile(0, 2);
const STAND = tile(1, 2);
const ROD = tile(2, 2);
const SLATE = colour('#5d6b84');
const PALE = colour('#8e9bb3');
const STEEL = colour('#c3cad6');
const LIGHT = colour('#fff6e3');
const DARK = colour('#1d2433');

/** @param world joints at rest, without rotation */
export function buildJointsMesh(world: Float64Array): MeshBuilder {
  const mesh = new MeshBuilder(ATLAS_SIZE);
  const still: Weights = new Map([[0, 1]]);
  ROWS.forEach((_, r) => {
    const height = r * STEP_HEIGHT;
    const half: Vec3 = [WIDTH / 2, (height + 0.06) / 2, STEP_DEPTH / 2];
    addBlock(mesh, [0, height - half[1], -r * STEP_DEPTH], half, STEP, STEP, still);
  });
  PLACED.forEach(({ exhibit, plinth }, i) => {
    const weights: Weights = new Map([[i + 1, 1]]);
    const pivot: Vec3 = [world[16 * i + 28], world[16 * i + 29], world[16 * i + 30]];
    if (!exhibit.isChild && !exhibit.isBeside) {
      const { half, height } = PLINTH;
      addBlock(mesh, add(plinth, [0, -height / 2, 0]), [half, height / 2, half], STAND, STAND, still);
    }
    for (const [from, to] of exhibit.rods ?? []) addRod(mesh, add(plinth, from), add(plinth, to), still);
    addPiece(mesh, exhibit.piece, pivot, exhibit.family, weights);
  });
  return mesh;
}

function addPiece(mesh: MeshBuilder, piece: Piece, pivot: Vec3, family: Family, weights: Weights): void {
  const { side, front } = FACES[family];
  if (piece.kind === 'block') addBlock(mesh, add(pivot, piece.centre), piece.half, side, front, weights);
  else if (piece.kind === 'ball') {
    const centre = add(pivot, piece.centre);
    mesh.addPart({
      point: (angle, v) => {
        const up = (v - 0.5) * Math.PI;
        const round = piece.radius * Math.cos(up);
        return add(centre, [round * Math.sin(angle), piece.radius * Math.sin(up), round * Math.cos(angle)]);
      },
      angles: around(12),
      rows: along(8),
      startPole: true,
      endPole: true,
      rect: side,
      weights: () => weights,
    });
  } else addWheel(mesh, piece.radius, pivot, side, front, weights);
}

const HALF_THICK = 0.06;
/** A disc: its front is a patch bent round, so that its mark rotates with it. */
function addWheel(mesh: MeshBuilder, radius: number, at: Vec3, side: Rect, front: Rect, weights: Weights): void {
  for (const z of [HALF_THICK, -HALF_THICK]) {
    mesh.addPatch({
      columns: 4,
      rows: 4,
      point: (s, t) => {
        const [x, y] = [(2 * s - 1) * Math.sign(z), 2 * t - 1];
        const [u, w] = [x * Math.sqrt(1 - (y * y) / 2), y * Math.sqrt(1 - (x * x) / 2)];
        return add(at, [radius * u, radius * w, z]);
      },
      rect: front,
      weights: () => weights,
    });
  }
  mesh.addPatch({
    columns: 16,
    rows: 1,
    point: (s, t) => {
      const a = 2 * Math.PI * s;
      return add(at, [radius * Math.sin(a), radius * Math.cos(a), HALF_THICK * (1 - 2 * t)]);
    },
    rect: side,
    weights: () => weights,
  });
}

/** Six flat faces: right × up of each points outwards. */
function addBlock(mesh: MeshBuilder, at: Vec3, half: Vec3, side: Rect, front: Rect, weights: Weights): void {
  const [x, y, z]: Vec3[] = [
    [half[0], 0, 0],
    [0, half[1], 0],
    [0, 0, half[2]],
  ];
  const back = (v: Vec3) => scaled(v, -1);
  addFace(mesh, add(at, z), x, y, front, weights);
  addFace(mesh, add(at, back(z)), back(x), y, side, weights);
  addFace(mesh, add(at, x), back(z), y, side, weights);
  addFace(mesh, add(at, back(x)), z, y, side, weights);
  addFace(mesh, add(at, y), x, back(z), side, weights);
  addFace(mesh, add(at, back(y)), x, z, side, weights);
}

function addFace(mesh: MeshBuilder, middle: Vec3, right: Vec3, up: Vec3, rect: Rect, weights: Weights): void {
  mesh.addPatch({
    columns: 1,
    rows: 1,
    point: (s, t) => add(middle, add(scaled(right, 2 * s - 1), scaled(up, 2 * t - 1))),
    rect,
    weights: () => weights,
  });
}

const ROD_RADIUS = 0.03;
/** Six-sided, with open ends. */
function addRod(mesh: MeshBuilder, from: Vec3, to: Vec3, weights: Weights): void {
  const axis = normalise(subtract(to, from));
  const side = normalise(cross(axis, Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const front = cross(side, axis);
  mesh.addPart({
    point: (angle, v) => {
      const out = add(scaled(side, ROD_RADIUS * Math.sin(angle)), scaled(front, ROD_RADIUS * Math.cos(angle)));
      return add(add(from, scaled(subtract(to, from), v)), out);
    },
    angles: around(6),
    rows: [0, 1],
    startPole: false,
    endPole: false,
    rect: ROD,
    weights: () => weights,
  });
}

/** A face with a light edge, and lines that show how it is stretched. */
function face(base: Colour): (u: number, v: number) => Colour {
  const edge = blend(base, LIGHT, 0.55);
  const line = blend(base, DARK, 0.22);
  return (u, v) => {
    const rim = Math.min(u, v, 1 - u, 1 - v);
    if (rim < 0.06) return edge;
    const grid = Math.min(...[0.25, 0.5, 0.75].flatMap((x) => [Math.abs(u - x), Math.abs(v - x)]));
    return grid < 0.022 ? line : base;
  };
}

/** The same with an arrow that points up. */
function marked(base: Colour): (u: number, v: number) => Colour {
  const plain = face(base);
  return (u, v) => {
    const x = Math.abs(u - 0.5);
    const isHead = v > 0.52 && v < 0.8 && x < 0.8 * (0.8 - v);
    const isShaft = v > 0.22 && v <= 0.52 && x < 0.075;
    return isHead || isShaft ? LIGHT : plain(u, v);
  };
}

export function paintJoints(): Atlas {
  const atlas = new Atlas(ATLAS_SIZE, SLATE);
  for (const { side, front, colour: base } of Object.values(FACES)) {
    atlas.paint(side, face(base));
    atlas.paint(front, marked(base));
  }
  atlas.paint(STEP, () => SLATE);
  atlas.paint(STAND, (u, v) => (Math.min(u, v, 1 - u, 1 - v) < 0.05 ? blend(PALE, LIGHT, 0.4) : PALE));
  atlas.paint(ROD, () => STEEL);
  return atlas;
}
