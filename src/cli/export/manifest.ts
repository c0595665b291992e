/**
 * The manifest of an export: what became of each take, a line of JSON each, sorted by bytes.
 *
 *     manifest.ndjson            of all takes; written once all are done
 *     manifest.2-of-4.ndjson     of part 2 of 4; the part that is done last joins all four to manifest.ndjson
 *     .marrow/, .marrow-2-of-4/  while it runs, a folder for the run: unfinished files, and the journal: lines in the
 *                                order of being done. A new run removes those of runs that were killed
 *
 * Lines begin with the input, so `LC_ALL=C sort` of the parts is the whole.
 */
import { randomBytes } from 'node:crypto';
import { appendFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { basename, join } from 'node:path';
import { CommandError } from '../../edit/command-error.ts';
import { writeOutput } from '../write-output.ts';
import { lineOf, recordsIn, type TakeRecord } from './records.ts';
import type { Shard } from './switches.ts';
import { compareBytes } from './take-inputs.ts';

const WHOLE = 'manifest.ndjson';
const JOURNAL = 'journal.ndjson';

const PART = /^manifest\.\d+-of-(\d+)\.ndjson$/;

function partName({ index, count }: Shard): string {
  return `manifest.${index}-of-${count}.ndjson`;
}

const SCRATCH = /^\.marrow(-\d+-of-\d+)?$/;

/** Of all runs of a part. */
function scratchFolder(out: string, shard: Shard | undefined): string {
  return join(out, shard ? `.marrow-${shard.index}-of-${shard.count}` : '.marrow');
}

/** The records of earlier runs, by input: those of the whole, of parts, and, newest, of unfinished runs. */
export function earlierRecords(out: string): ReadonlyMap<string, readonly TakeRecord[]> {
  const names = existsSync(out) ? readdirSync(out) : [];
  const manifests = [WHOLE, ...names.filter((name) => PART.test(name))];
  const journals = names
    .filter((name) => SCRATCH.test(name))
    .flatMap((name) => readdirSync(join(out, name)).map((run) => join(name, run, JOURNAL)));
  const byInput = new Map<string, readonly TakeRecord[]>();
  for (const name of [...manifests, ...journals]) {
    const path = join(out, name);
    if (!existsSync(path)) continue;
    const inputs = new Map<string, TakeRecord[]>();
    for (const record of recordsIn(readFileSync(path, 'utf8'))) {
      const known = inputs.get(record.input);
      if (known) known.push(record);
      else inputs.set(record.input, [record]);
    }
    for (const [input, records] of inputs) byInput.set(input, records);
  }
  return byInput;
}

/** The journal of a run, and in the end its manifest. */
export class Manifest {
  /** The run's own folder, for unfinished files; absolute. */
  readonly scratch: string;
  private readonly name: string;
  private readonly records: TakeRecord[] = [];

  /**
   * Removes what an earlier run of the same part left unfinished, and its manifest, which is there when all is done.
   * @param earlier records of that run; they stay in the journal until they are replaced
   */
  constructor(
    private readonly out: string,
    private readonly shard: Shard | undefined,
    earlier: readonly TakeRecord[],
  ) {
    const folder = scratchFolder(out, shard);
    this.scratch = join(folder, randomBytes(4).toString('hex'));
    this.name = shard ? partName(shard) : WHOLE;
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(this.scratch, { recursive: true });
    this.append(earlier);
    rmSync(join(out, this.name), { force: true });
  }

  /** All records of one input: written at once, so that an input is in the journal whole or not at all. */
  add(records: readonly TakeRecord[]): void {
    this.records.push(...records);
    this.append(records);
  }

  /** @throws Error if it can't be written */
  finish(): void {
    const { out, shard, scratch, records, name } = this;
    this.append([]);
    write(join(out, name), records.map(lineOf), scratch);
    if (!shard || joinParts(out, shard, scratch)) removeOtherParts(out, shard);
    rmSync(scratchFolder(out, shard), { recursive: true, force: true });
  }

  private append(records: readonly TakeRecord[]): void {
    if (!existsSync(this.scratch)) {
      // A scheduler that took this process for dead has started its part again.
      throw new CommandError(`Another export of the same takes to ${this.out} has started; this one stops.`);
    }
    appendFileSync(join(this.scratch, JOURNAL), records.map(lineOf).join(''));
  }
}

/** Writes the whole manifest if all parts are there. @returns whether they are */
function joinParts(out: string, { count }: Shard, scratch: string): boolean {
  const paths: string[] = [];
  // As many as someone wrote, which may be more than a list has room for.
  for (let index = 1; index <= count; index++) {
    const path = join(out, partName({ index, count }));
    if (!existsSync(path)) return false;
    paths.push(path);
  }
  const lines = paths.flatMap((path) => readFileSync(path, 'utf8').split('\n'));
  write(
    join(out, WHOLE),
    lines.filter((line) => line !== '').map((line) => `${line}\n`),
    scratch,
  );
  return true;
}

/** Parts of earlier runs in another number of parts. */
function removeOtherParts(out: string, shard: Shard | undefined): void {
  for (const name of readdirSync(out)) {
    const count = PART.exec(name)?.[1];
    if (count !== undefined && Number(count) !== shard?.count) rmSync(join(out, name), { force: true });
  }
}

function write(path: string, lines: readonly string[], scratch: string): void {
  const written = writeOutput(path, [[...lines].sort(compareBytes).join('')], scratch);
  if ('failure' in written) throw new CommandError(`${basename(path)} could not be written: ${written.failure}.`);
}
