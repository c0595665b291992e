/** Exports all takes of a list, with several threads, and writes the manifest. */
import { createHash } from 'node:crypto';
import { VERSION } from '../../model/version.ts';
import { shareWork } from '../threads.ts';
import { earlierRecords, Manifest } from './manifest.ts';
import { LAYOUT } from './meta.ts';
import { type ExportPiece, type ExportResult, exportWork } from './one-take.ts';
import { hashOf } from './read-input.ts';
import { type FailedTake, isWritten, type TakeRecord } from './records.ts';
import type { ExportSettings } from './settings.ts';
import { inShard, type Shard } from './switches.ts';
import type { TakeInput } from './take-inputs.ts';

export interface ExportTask {
  readonly settings: Omit<ExportSettings, 'key' | 'scratch'>;
  /** All of them, of all parts. */
  readonly inputs: readonly TakeInput[];
  readonly shard: Shard | undefined;
  /** Whether unchanged takes of an earlier run are skipped. */
  readonly resumes: boolean;
  /** Absent: as many as cores. */
  readonly threads: number | undefined;
  /** Absolute paths of files that all takes depend on: the target of retargeting, its map. */
  readonly dependsOn: readonly string[];
}

export interface ExportSummary {
  /** Takes written in this run, and how many of all inputs had been before. */
  readonly written: number;
  readonly kept: number;
  readonly bytes: number;
  /** Takes whose files have something wrong. */
  readonly warned: number;
  /** What files don't state and was assumed, with how many of the takes written it concerns. */
  readonly notes: readonly { readonly note: string; readonly takes: number }[];
  readonly failures: readonly FailedTake[];
  /** Inputs that hold no take by their kind. */
  readonly skipped: readonly { readonly input: string; readonly why: string }[];
  /** Outputs of earlier runs that are none of this list any more. */
  readonly stale: readonly string[];
}

/** Starting a thread takes about as long as a few takes. */
const FEW = 4;

const NO_RECORDS: ReadonlyMap<string, readonly TakeRecord[]> = new Map();

/** @param told after each input, with how many are done and how many of them failed */
export async function exportTakes(
  { settings, inputs, shard, resumes, threads, dependsOn }: ExportTask,
  program: URL | undefined,
  told: (done: number, of: number, failed: number) => void,
): Promise<ExportSummary> {
  const { out } = settings;
  const key = keyOf(settings, dependsOn);
  // Without --resume and --force, nothing is overwritten, nor is what the manifest says of it.
  const adds = !settings.replaces;
  const known = resumes || adds ? earlierRecords(out) : NO_RECORDS;
  const earlier = resumes ? known : NO_RECORDS;
  const pieces = inShard(inputs, shard).map((input): ExportPiece => ({ input, before: earlier.get(input.path) ?? [] }));
  const manifest = new Manifest(out, shard, adds ? [...known.values()].flat() : pieces.flatMap(({ before }) => before));
  const failures: FailedTake[] = [];
  const skipped: ExportSummary['skipped'][number][] = [];
  const replaced: string[] = [];
  const notes = new Map<string, number>();
  let [written, kept, bytes, warned, done] = [0, 0, 0, 0, 0];
  await shareWork(
    {
      name: 'export',
      work: exportWork,
      shared: { ...settings, scratch: manifest.scratch, key },
      pieces,
      ...(threads !== undefined && { threads }),
      few: FEW,
      done({ input, before }, { records, isKept, skipped: why }: ExportResult) {
        if (why !== undefined) skipped.push({ input: input.path, why });
        const there = adds && !records.some(isWritten) ? known.get(input.path)?.filter(isWritten) : undefined;
        manifest.add(there?.length ? there : records);
        const outputs = new Set(records.filter(isWritten).map(({ output }) => output));
        replaced.push(...before.filter(isWritten).flatMap(({ output }) => (outputs.has(output) ? [] : [output])));
        for (const record of records) {
          if (!isWritten(record)) failures.push(record);
          else if (isKept) kept++;
          else {
            written++;
            bytes += record.bytes;
            if (record.warnings) warned++;
            for (const note of record.notes ?? []) notes.set(note, (notes.get(note) ?? 0) + 1);
          }
        }
        told(++done, pieces.length, failures.length);
      },
      lost: ({ input }, reason): ExportResult => ({
        records: [{ input: input.path, error: `This take crashed its thread: ${reason}.` }],
        isKept: false,
      }),
    },
    program,
  );
  const listed = new Set(inputs.map(({ path }) => path));
  if (adds && !shard) for (const [input, records] of known) if (!listed.has(input)) manifest.add(records);
  manifest.finish();
  const gone = [...earlier].filter(([input]) => !listed.has(input)).flatMap(([, records]) => records);
  for (const list of [failures, skipped]) list.sort((a, b) => (a.input < b.input ? -1 : 1));
  const unlisted = gone.filter(isWritten).map(({ output }) => output);
  return {
    written,
    kept,
    bytes,
    warned,
    notes: listedNotes(notes),
    failures,
    skipped,
    stale: [...unlisted, ...replaced.sort()],
  };
}

/** The most frequent first. */
function listedNotes(notes: ReadonlyMap<string, number>): ExportSummary['notes'] {
  return [...notes]
    .map(([note, takes]) => ({ note, takes }))
    .sort((a, b) => b.takes - a.takes || (a.note < b.note ? -1 : 1));
}

/** Of everything but the input that decides what its outputs are: any option that isn't about where and when. */
function keyOf(settings: ExportTask['settings'], dependsOn: readonly string[]): string {
  const { folder: _f, out: _o, parts: _p, replaces: _r, isTimed: _t, ...deciding } = settings;
  return createHash('sha256')
    .update(JSON.stringify([VERSION, LAYOUT, deciding, dependsOn.map(hashOf)]))
    .digest('hex');
}
