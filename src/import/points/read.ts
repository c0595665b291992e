/**
 * Points of a file as captures: bones are fitted to those whose labels are a known tree; any others are points, each by
 * itself.
 */
import { capturesOfFrames } from '../../evaluate/captured-frames.ts';
import { pointCapture } from '../../evaluate/point-capture.ts';
import { metresPerUnit, statedSpace } from '../../evaluate/space/metres.ts';
import { liftOntoGround, spaceText, upText } from '../../evaluate/space/space.ts';
import { guessedHeight, guessSharedSpace } from '../../evaluate/space/space-guess.ts';
import { type JointTree, treeOfLabels, treesOf } from '../../evaluate/tree-fit/known-trees.ts';
import type { PointPaths } from '../../evaluate/tree-fit/point-paths.ts';
import { stemOfName } from '../../formats/grammar.ts';
import { Report } from '../../formats/report.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Capture } from '../../model/files.ts';
import type { FileSpace, Space } from '../../model/space.ts';
import { Budget } from '../budget.ts';
import { fitted } from '../fitted.ts';
import { counted, type Import, ImportError, Remarks } from '../imported.ts';
import { readC3d } from './c3d.ts';
import { readPointRows } from './csv.ts';
import { fail, POINT_WIDTH, PointsError, type PointTable } from './table.ts';
import { readTrc } from './trc.ts';

/** Kinds of files with points. */
export type PointsKind = 'c3d' | 'trc' | 'csv';

/** Captures with the space that they share. */
export interface ReadPoints {
  readonly captures: readonly Capture[];
  readonly space: FileSpace;
}

const READERS: {
  readonly [K in PointsKind]: (bytes: Uint8Array, budget: Budget, remarks: Remarks) => PointTable | undefined;
} = { c3d: readC3d, trc: readTrc, csv: readPointRows };

/**
 * The captures of a file; absent, without errors, if it is a table of something else, and with errors if it has some.
 * Never throws for anything that the file holds.
 */
export function readPoints(
  kind: PointsKind,
  { fileName, bytes }: Pick<Import, 'fileName' | 'bytes'>,
): { readonly value?: ReadPoints; readonly diagnostics: readonly Diagnostic[] } {
  const remarks = new Remarks(fileName);
  try {
    const budget = new Budget(bytes.length, (message) => fail('points-large', message));
    const table = READERS[kind](bytes, budget, remarks);
    if (!table) return { diagnostics: [] };
    const value = capturesOf(table, stemOfName(fileName), budget, remarks);
    return { value, diagnostics: remarks.finish() };
  } catch (error) {
    if (!(error instanceof ImportError)) throw error;
    if (!(error instanceof PointsError)) return { diagnostics: [...remarks.finish(), remarks.error(error)] };
    const report = new Report(fileName);
    report.error(error.code, error.message, error.place);
    return { diagnostics: [...remarks.finish(), ...report.finish()] };
  }
}

function capturesOf(table: PointTable, name: string, budget: Budget, remarks: Remarks): ReadPoints {
  const { frameCount, framesPerSecond, values, labels } = table;
  const pointCount = labels.length;
  const tree = treeIn(table, remarks);
  if (!tree) {
    const captures = [pointCapture(name, { labels, frameCount, framesPerSecond, values })];
    return { captures, space: spaceOf(captures, table, remarks) };
  }
  const paths: PointPaths = { frameCount, pointCount, width: POINT_WIDTH, values };
  budget.spend(3 * (tree.names.length + 1) * frameCount, `A take of ${tree.names.length} joints`);
  const { joints, frames, isDown, told } = fitted(paths, tree, framesPerSecond, remarks);
  const captures = capturesOfFrames(name, joints, frames);
  told();
  return { captures, space: spaceOf(captures, table, remarks, isDown) };
}

/** Labels of this many points are told. */
const MAX_TOLD = 10;

/** The known tree that the labels have, if all of its points are there at some time. */
function treeIn(table: PointTable, remarks: Remarks): JointTree | undefined {
  const { labels, values, frameCount } = table;
  const pointCount = labels.length;
  const tree = table.isNumbered ? treesOf(pointCount)[0] : treeOfLabels(labels);
  if (!tree) return undefined;
  const used = new Set(tree.points.flat());
  let [missing, neverThere] = [0, ''];
  for (const p of used) {
    let there = 0;
    for (let frame = 0; frame < frameCount; frame++) there += values[POINT_WIDTH * (frame * pointCount + p) + 3];
    if (there === 0) neverThere = labels[p];
    missing += frameCount - there;
  }
  if (neverThere !== '') {
    const message = `Its labels are those of ${tree.label}, but ${neverThere} is missing in all frames.`;
    remarks.tell('tree-incomplete', message, 'kept as points, without bones');
    return undefined;
  }
  const how = table.isNumbered ? 'numbered as those of' : 'those of';
  remarks.tell('tree-assumed', `Its ${used.size} points are ${how} ${tree.label}.`, 'used its tree');
  if (missing > 0) {
    const message = `Points are missing in some frames, ${counted(missing, 'time')} in all.`;
    remarks.tell('points-missing', message, 'held where they were');
  }
  const others = labels.filter((_, p) => !used.has(p));
  const more = others.length > MAX_TOLD ? [`${others.length - MAX_TOLD} more`] : [];
  if (others.length > 0) remarks.leaveOut(`points of no joint (${[...others.slice(0, MAX_TOLD), ...more].join(', ')})`);
  return tree;
}

/** The axis along which the first frame is tallest. */
function upOf({ labels, values }: PointTable): Space['up'] {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let p = 0; p < labels.length; p++) {
    const at = POINT_WIDTH * p;
    if (values[at + 3] === 0) continue;
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k], values[at + k]);
      max[k] = Math.max(max[k], values[at + k]);
    }
  }
  return max[2] - min[2] > max[1] - min[1] ? 'z' : 'y';
}

/** A ground that the lowest points are this far off, in heights, below or above, is believed. */
const BELIEVED = [-0.05, 0.15] as const;

/** As the file states it; what it doesn't is guessed, and said. */
function spaceOf(captures: readonly Capture[], table: PointTable, remarks: Remarks, isDown = false): FileSpace {
  const axis = upOf(table);
  const up = isDown && axis === 'y' ? '-y' : axis;
  if (table.metres === undefined) {
    const guessed = guessSharedSpace(captures, up);
    const used = `used ${metresPerUnit(guessed.space)} m per unit, ${upText(guessed.space)}`;
    remarks.tell('unit-guessed', 'The file states neither its unit nor its up axis.', used);
    return guessed;
  }
  const stated = statedSpace(table.metres);
  const space: Space = { ...stated.space, up };
  remarks.tell('up-assumed', 'The file does not state its up axis.', `used ${spaceText(space)}`);
  const [{ skeleton, take }] = captures;
  const low = -liftOntoGround(skeleton, take, space);
  const height = guessedHeight(skeleton, take, up, true).height * metresPerUnit(space);
  const isOnGround = low >= BELIEVED[0] * height && low <= BELIEVED[1] * height;
  return { ...stated, space: isOnGround ? space : { ...space, lift: -low } };
}
