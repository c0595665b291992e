/** Words for the numbers of a dump, for messages: what was found where something else was expected. */
import type { DumpBlock, DumpHeading } from '../../model/dump.ts';

/** Parts of a text. */
const MAX_PARTS = 4;

interface Run {
  readonly from: number;
  to: number;
  readonly width: number;
  rows: number;
}

/** `93 numbers: line 1 has 1 number; lines 4–95 look like 23 matrices`. */
export function foundText(block: DumpBlock, headings: readonly DumpHeading[]): string {
  const runs = runsOf(block, headings);
  const parts = runs.slice(0, MAX_PARTS).map(runText);
  if (runs.length > MAX_PARTS) parts.push(`and ${counted(runs.length - MAX_PARTS, 'other part')}`);
  return `${counted(block.values.length, 'number')}: ${parts.join('; ')}`;
}

/** `1 number`, `2 numbers`. */
export function counted(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? '' : 's'}`;
}

/** Rows of the same number of values, one after the other, and headings before and between them. */
function runsOf({ starts, lines }: DumpBlock, headings: readonly DumpHeading[]): readonly Run[] {
  const runs: Run[] = [];
  const add = (line: number, width: number) => {
    const last = runs.at(-1);
    if (last?.width === width) [last.to, last.rows] = [line, last.rows + 1];
    else runs.push({ from: line, to: line, width, rows: 1 });
  };
  let next = 0;
  lines.forEach((line, r) => {
    while (next < headings.length && headings[next].line < line) add(headings[next].line, headings[next++].numbers);
    add(line, starts[r + 1] - starts[r]);
  });
  return runs;
}

function runText({ from, to, width, rows }: Run): string {
  const where = from === to ? `line ${from}` : `lines ${from}–${to}`;
  const all = width * rows;
  const look = from === to ? 'looks' : 'look';
  if (width === 16 || width === 12) return `${where} ${look} like ${rows === 1 ? '1 matrix' : `${rows} matrices`}`;
  if (width === 4 && rows > 1 && all % 16 === 0)
    return `${where} look like ${all === 16 ? '1 matrix' : `${all / 16} matrices`}`;
  if (width === 3) return `${where} ${look} like ${counted(rows, 'point')}`;
  if (rows === 1) return `${where} has ${counted(width, 'number')}`;
  return `${where} have ${counted(width, 'number')} each`;
}
