/** Times of frames as a table that can be copied into a document. */
import { percentile } from '../../../src/evaluate/space/frame-shapes.ts';
import type { WatchedFrames } from './frame-watch.ts';

/** What was measured of a scene; what is absent doesn't exist, or failed. */
export interface Row {
  readonly label: string;
  readonly page?: WatchedFrames;
  readonly peer?: WatchedFrames;
  readonly openingMs?: number;
}

const NONE = '–';
const HEAD = [
  'scene',
  'Marrow',
  'its script',
  'three.js alone',
  'its script',
  'ratio',
  'beyond the floor',
  'opened in',
];

const one = (ms: number) => ms.toFixed(1);
const spread = (times: readonly number[]) => `${one(percentile(times, 0.5))} (${one(percentile(times, 0.95))})`;

/**
 * The ratio of two medians, above what a frame costs that draws nothing; undefined where three.js is not above it, by a
 * tenth of a millisecond: a ratio to that says nothing.
 */
export function ratio(page: readonly number[], peer: readonly number[], floorMs: number): number | undefined {
  const below = percentile(peer, 0.5) - floorMs;
  return below > 0.1 ? (percentile(page, 0.5) - floorMs) / below : undefined;
}

/** Milliseconds: medians, and in brackets the 95th percentile. @param floor frames that draw nothing */
export function tableOf(rows: readonly Row[], floor: WatchedFrames): string {
  const floorMs = percentile(floor.whole, 0.5);
  const times = (above: number | undefined) => (above === undefined ? NONE : `${above.toFixed(2)} ×`);
  const cells = rows.map(({ label, page, peer, openingMs }) => {
    const both = (above: number) => times(page && peer && ratio(page.whole, peer.whole, above));
    const frames = [page, peer].flatMap((of) => (of ? [spread(of.whole), spread(of.script)] : [NONE, NONE]));
    const opened = openingMs === undefined ? NONE : `${(openingMs / 1000).toFixed(2)} s`;
    return [label, ...frames, both(0), both(floorMs), opened];
  });
  const empty = ['nothing: the floor', NONE, NONE, spread(floor.whole), spread(floor.script), NONE, NONE, NONE];
  return markdown([HEAD, ...cells, empty]);
}

function markdown(rows: readonly (readonly string[])[]): string {
  const widths = rows[0].map((_, c) => Math.max(...rows.map((row) => row[c].length)));
  const [head, ...others] = rows.map((row) => `| ${row.map((cell, c) => cell.padEnd(widths[c])).join(' | ')} |`);
  return [head, `| ${widths.map((width) => '-'.repeat(width)).join(' | ')} |`, ...others].join('\n');
}
