/**
 * Points of OpenSim's `.trc` (Motion Analysis): cells between tabs.
 *
 *     1   PathFileType …
 *     2   names of what follows: DataRate, NumFrames, NumMarkers, Units …
 *     3   its values
 *     4   Frame#  Time  LABEL (of three columns) …
 *     5   X1  Y1  Z1 …
 *     then rows: number of the frame, time, x y z of each point
 */
import { USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import type { Budget } from '../budget.ts';
import { counted, type Remarks } from '../imported.ts';
import { lineCount, Rows, TAB, writePoint } from './rows.ts';
import {
  fail,
  holdMissing,
  isRate,
  labelsFor,
  MAX_POINTS,
  metresOf,
  POINT_WIDTH,
  type PointTable,
  roomFor,
} from './table.ts';
import { rateOfTimes } from './times.ts';

/** Columns before those of the points. */
const FIRST = 2;

/** The points of a `.trc`. @throws PointsError if it is none, or a cell is no number */
export function readTrc(bytes: Uint8Array, budget: Budget, remarks: Remarks): PointTable {
  const rows = new Rows(bytes, TAB);
  if (!rows.next() || rows.text(0).toLowerCase() !== 'pathfiletype') {
    fail('trc-head', 'Expected PathFileType in the first line of a .trc.', rows.place());
  }
  const head = headOf(rows);
  const labels = labelsIn(rows, head);
  const pointCount = labels.length;
  if (!rows.next()) fail('frames-missing', 'Expected X1, Y1, Z1 and rows of numbers, found none.');
  const most = Math.max(1, lineCount(bytes) - rows.line);
  const values = roomFor(pointCount, most, budget);
  const times = new Float64Array(most);
  let frameCount = 0;
  let missing = 0;
  while (rows.next()) {
    if (rows.count === 0) continue;
    rows.number(0);
    times[frameCount] = rows.numberOrNone(1);
    if (rows.count > FIRST + 3 * pointCount) {
      const message = `Expected at most ${FIRST + 3 * pointCount} numbers in a row, found ${rows.count}.`;
      fail('row-too-long', message, rows.place(FIRST + 3 * pointCount));
    }
    const from = POINT_WIDTH * pointCount * frameCount;
    for (let p = 0, c = FIRST; p < pointCount; p++, c += 3) {
      if (!writePoint(rows, c, c + 1, c + 2, values, from + POINT_WIDTH * p)) missing++;
    }
    frameCount++;
  }
  if (frameCount === 0) fail('frames-missing', 'Expected rows of numbers after the labels, found none.');
  const own = values.subarray(0, POINT_WIDTH * pointCount * frameCount);
  if (missing > 0) holdMissing(own, pointCount, frameCount);
  told(head, { pointCount, frameCount }, remarks);
  const metres = metresOf(head.get('units') ?? '');
  return {
    labels: labelsFor(labels, pointCount),
    frameCount,
    framesPerSecond: rateIn(head, times.subarray(0, frameCount), remarks),
    values: own.length < values.length ? own.slice() : values,
    ...(metres !== undefined && { metres }),
  };
}

/** Values of the third line by the names of the second, in lower case. */
function headOf(rows: Rows): ReadonlyMap<string, string> {
  const names = rows.next() ? rows.texts() : [];
  const values = rows.next() ? rows.texts() : [];
  return new Map(names.map((name, i) => [name.toLowerCase(), values[i] ?? '']));
}

/** Labels are above the first of three columns, or, in some files, beside each other. */
function labelsIn(rows: Rows, head: ReadonlyMap<string, string>): readonly string[] {
  const cells = rows.next() ? rows.texts().slice(FIRST) : [];
  const named = cells.filter((cell) => cell !== '');
  if (named.length === 0) {
    fail(
      'points-missing',
      'Expected Frame#, Time and labels of points in the fourth line, found no label.',
      rows.place(),
    );
  }
  if (named.length > MAX_POINTS) fail('points-many', `Expected at most ${MAX_POINTS} points, found ${named.length}.`);
  if (named.length === Number(head.get('nummarkers'))) return named;
  const isSpread = cells.some((cell, c) => cell !== '' && c % 3 !== 0);
  if (isSpread) return named;
  return Array.from({ length: Math.ceil(cells.length / 3) }, (_, p) => cells[3 * p]);
}

function rateIn(head: ReadonlyMap<string, string>, times: Float64Array, remarks: Remarks): number {
  const stated = Number(head.get('datarate')?.replace(',', '.') || Number.NaN);
  if (isRate(stated)) return stated;
  const rate = rateOfTimes(times);
  const message = `Expected frames per second in DataRate, found ${head.get('datarate') || 'none'}.`;
  const used = rate === undefined ? `used ${USUAL_FRAMES_PER_SECOND}` : `used ${rate}, from the times of the rows`;
  remarks.warn('rate-expected', message, used);
  return rate ?? USUAL_FRAMES_PER_SECOND;
}

/** What is stated and isn't so. */
function told(
  head: ReadonlyMap<string, string>,
  { pointCount, frameCount }: Pick<PointTable, 'frameCount'> & { readonly pointCount: number },
  remarks: Remarks,
): void {
  const differs = (name: string, what: string, found: number) => {
    const stated = head.get(name.toLowerCase());
    if (stated === undefined || stated === '' || Number(stated) === found) return;
    const message = `${name} states ${stated}, and there ${found === 1 ? 'is' : 'are'} ${counted(found, what)}.`;
    remarks.warn('count-differs', message, 'used what is there');
  };
  differs('NumMarkers', 'point', pointCount);
  differs('NumFrames', 'frame', frameCount);
  const unit = head.get('units') ?? '';
  if (unit !== '' && metresOf(unit) === undefined) {
    remarks.warn('unit-unknown', `Expected a unit such as mm in Units, found ${unit}.`, 'guessed');
  }
}
