/** A few of the numbers that are compared, those that most mistakes show in, with what of the character they need. */
import { normalsOf } from '../../evaluate/skin/normals.ts';
import type { Character } from '../../model/document.ts';
import { shownSkin } from '../../model/document.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import { oneSurface, type Skin } from '../../model/skin.ts';
import { pointError } from '../compare/errors.ts';
import type { ChannelTarget, FrameTarget } from '../compare/targets.ts';
import { valuesNearest } from '../program/own-values.ts';
import type { Cell, CellPiece } from './cells.ts';

/** Vertices that are kept, and samples per channel. */
const FEW_VERTICES = 24;
const FEW_SAMPLES = 6;

/** Ours at each of the times: three numbers a vertex. */
type OwnPoints = readonly { readonly vertices: Float64Array; readonly normals: Float64Array }[];

/**
 * The character with a few of its vertices, and what is compared of them.
 *
 * @param own our numbers, at each of the times
 */
export function fewOf(
  character: Character,
  frames: readonly FrameTarget[],
  cells: readonly Cell[],
  own: OwnPoints,
  tolerance: number,
): { readonly character: Character; readonly cells: readonly Cell[] } {
  const skin = shownSkin(character);
  const few = skin ? chosen(skin, worstVertices(frames, own)) : [];
  const pick = (values: Float64Array | undefined) => values && rowsOf(values, few);
  return {
    character: skin
      ? { ...character, skins: [skinOf(skin, few)], shownSkin: 0, morphs: character.morphs.map((m) => morphOf(m, few)) }
      : character,
    cells: cells.map((cell): Cell => {
      const pieces = cell.pieces.map(({ frame, target }): CellPiece => {
        const [vertices, normals] = [pick(target.vertices), pick(target.normals)];
        return { frame, target: { ...target, ...(vertices && { vertices }), ...(normals && { normals }) } };
      });
      return { ...cell, pieces, channels: fewSamples(character, cell.channels, tolerance) };
    }),
  };
}

/** The worst, some evenly spread, and those that mistakes in attachments show at. */
function chosen({ positions, attachments }: Skin, worst: readonly number[]): number[] {
  const count = positions.length / 3;
  const all = new Set(worst.slice(0, FEW_VERTICES / 2));
  const most = (of: (joint: number, weights: Float64Array) => number) => {
    if (!attachments) return;
    const { start, joints, weights } = attachments;
    let best = 0;
    let value = Number.NEGATIVE_INFINITY;
    for (let v = 0; v < count; v++) {
      if (start[v] === start[v + 1]) continue;
      const own = of(joints[start[v]], weights.subarray(start[v], start[v + 1]));
      if (own > value) [best, value] = [v, own];
    }
    all.add(best);
  };
  most((joint) => joint);
  most((joint) => -joint);
  most((_, weights) => weights.length);
  most((_, weights) => Math.abs(weights.reduce((sum, w) => sum + w, -1)));
  for (let i = 0; i < FEW_VERTICES / 2 && i < count; i++) all.add(Math.floor((i * count) / (FEW_VERTICES / 2)));
  return [...all].sort((a, b) => a - b);
}

function rowsOf(values: Float64Array, rows: readonly number[]): Float64Array {
  return Float64Array.from({ length: 3 * rows.length }, (_, i) => values[3 * rows[Math.floor(i / 3)] + (i % 3)]);
}

function skinOf(skin: Skin, few: readonly number[]): Skin {
  const { positions, normals, attachments, bindings } = skin;
  const start = [0];
  const joints: number[] = [];
  const weights: number[] = [];
  for (const v of few) {
    for (let a = attachments?.start[v] ?? 0; a < (attachments?.start[v + 1] ?? 0); a++) {
      joints.push(attachments?.joints[a] ?? 0);
      weights.push(attachments?.weights[a] ?? 0);
    }
    start.push(joints.length);
  }
  return {
    name: skin.name,
    positions: rowsOf(positions, few),
    normals: rowsOf(normals ?? normalsOf(skin), few),
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings,
    ...(attachments && {
      attachments: {
        start: Uint32Array.from(start),
        joints: Uint32Array.from(joints),
        weights: Float64Array.from(weights),
      },
    }),
  };
}

function morphOf(morph: Morph, few: readonly number[]): Morph {
  const rows = ({ indices, values }: MorphRows): MorphRows => {
    const at = new Map(few.map((v, i) => [v, i]));
    const own: number[] = [];
    const kept: number[] = [];
    indices.forEach((v, row) => {
      const index = at.get(v);
      if (index === undefined) return;
      own.push(index);
      kept.push(...values.subarray(3 * row, 3 * row + 3));
    });
    return { indices: Uint32Array.from(own), values: Float64Array.from(kept) };
  };
  return { name: morph.name, positions: rows(morph.positions), normals: rows(morph.normals) };
}

/** Samples of each channel: those that differ most, and the first ones. */
function fewSamples(character: Character, target: ChannelTarget, tolerance: number): ChannelTarget {
  const { channels, times, values } = target;
  const own = valuesNearest(character, target, tolerance);
  const kept: number[] = [];
  for (let from = 0; from < channels.length; ) {
    let to = from;
    while (to < channels.length && channels[to] === channels[from]) to++;
    const rows = Array.from({ length: to - from }, (_, i) => from + i);
    rows.sort((a, b) => Math.abs(own[b] - values[b]) - Math.abs(own[a] - values[a]));
    kept.push(...rows.slice(0, FEW_SAMPLES).sort((a, b) => a - b));
    from = to;
  }
  return {
    channels: Uint32Array.from(kept, (i) => channels[i]),
    times: Float64Array.from(kept, (i) => times[i]),
    values: Float64Array.from(kept, (i) => values[i]),
  };
}

/** The vertices with the largest errors at any of the times, the worst first. */
function worstVertices(frames: readonly FrameTarget[], own: OwnPoints): number[] {
  const counts = frames.map(({ vertices, normals }) => ((vertices ?? normals)?.length ?? 0) / 3);
  const errors = new Float64Array(Math.max(0, ...counts));
  frames.forEach(({ vertices, normals }, f) => {
    for (const [theirs, ours] of [
      [vertices, own[f].vertices],
      [normals, own[f].normals],
    ] as const) {
      for (let o = 0; theirs && o < theirs.length; o += 3) {
        errors[o / 3] = Math.max(errors[o / 3], pointError(theirs, o, ours, o, 1));
      }
    }
  });
  const worst: number[] = [];
  for (let v = 0; v < errors.length; v++) {
    if (worst.length === FEW_VERTICES && errors[v] <= errors[worst[worst.length - 1]]) continue;
    const at = worst.findIndex((w) => errors[v] > errors[w]);
    worst.splice(at < 0 ? worst.length : at, 0, v);
    worst.length = Math.min(worst.length, FEW_VERTICES);
  }
  return worst;
}
