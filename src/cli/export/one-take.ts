/** Exports the takes of one input: what a thread does. */
import { createHash } from 'node:crypto';
import { existsSync, statSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { FloatPool } from '../../dataset/float-pool.ts';
import { takeOf } from '../../dataset/take.ts';
import { takeArrays } from '../../dataset/take-arrays.ts';
import { CommandError } from '../../edit/command-error.ts';
import type { Diagnostic, Severity } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { flagText } from '../../review/flags.ts';
import { atKnownRate } from '../known-rate.ts';
import { loadFound, openLoaded } from '../load.ts';
import { type GivenPath, isFile } from '../paths.ts';
import { reasonOf } from '../reason.ts';
import type { Work } from '../threads.ts';
import { writeInFolder } from '../write-output.ts';
import { type ExportedFile, FORMATS } from './formats.ts';
import { metaOf } from './meta.ts';
import { isMotion, motionFiles } from './motion-files.ts';
import { hashOfGiven, InputReader, type ReadInput } from './read-input.ts';
import { isWritten, type PartHash, type TakeRecord, type WrittenTake } from './records.ts';
import type { ExportSettings } from './settings.ts';
import { checkOf, flagsOf } from './take-check.ts';
import type { TakeInput } from './take-inputs.ts';
import { inSpaceOf, loadTarget, type Target } from './target.ts';

export interface ExportPiece {
  readonly input: TakeInput;
  /** Of an earlier run; the outputs are kept if nothing has changed. */
  readonly before: readonly TakeRecord[];
}

export interface ExportResult {
  readonly records: readonly TakeRecord[];
  /** Whether they are those of the earlier run. */
  readonly isKept: boolean;
  /** Why an input is none, by what it holds: a sentence. */
  readonly skipped?: string;
}

/** For the threads (`threads.ts`). */
export const exportWork: Work<ExportSettings, ExportPiece, ExportResult> = (settings) => {
  const loading = loadTarget(settings, settings.folder);
  const pool = new FloatPool(settings.precision);
  const inputs = new InputReader();
  const parts = new Map(settings.parts.map((part) => [part.path, part]));
  return async (piece) => exportInput(piece, { settings, target: await loading, pool, inputs, parts });
};

/** What a thread keeps from one input to the next. */
interface Exporter {
  readonly settings: ExportSettings;
  readonly target: Target;
  readonly pool: FloatPool;
  readonly inputs: InputReader;
  /** Parts of the settings, by path. */
  readonly parts: ReadonlyMap<string, GivenPath>;
}

async function exportInput({ input, before }: ExportPiece, exporter: Exporter): Promise<ExportResult> {
  const { settings } = exporter;
  const failed = (error: string, hash?: string): ExportResult => ({
    records: [{ input: input.path, ...(hash !== undefined && { hash }), error }],
    isKept: false,
  });
  let hash: string | undefined;
  try {
    if (input.why !== undefined) return failed(input.why);
    const read = exporter.inputs.read(input);
    hash = read.hash;
    const key = keyOf(settings.key, hash, input);
    const written = before.filter(isWritten);
    const isWhole = written.length > 0 && written.length === before.length;
    if (isWhole && written.every((take) => isThere(take, input, key, exporter))) {
      return { records: written, isKept: true };
    }
    return { ...(await takesOf(input, { ...read, key }, exporter)), isKept: false };
  } catch (error) {
    if (error instanceof CommandError) return failed(error.message, hash);
    return failed(`The export stopped: ${reasonOf(error)}.`, hash);
  }
}

/** What identifies an input and what is made of it. */
interface Identity extends ReadInput {
  readonly key: string;
}

/** Whether an earlier output is what would be made now. */
function isThere(
  { output, bytes, key: own, beside = [] }: WrittenTake,
  { stem }: TakeInput,
  key: string,
  { settings: { out, folder }, parts }: Exporter,
): boolean {
  if (own !== key || !output.startsWith(`${stem}.`)) return false;
  const isSame = ({ path, hash }: PartHash) => {
    const part = parts.get(path) ?? { absolute: resolve(folder, path) };
    return ('bytes' in part || isFile(part.absolute)) && hashOfGiven(part) === hash;
  };
  return statSync(join(out, output), { throwIfNoEntry: false })?.size === bytes && beside.every(isSame);
}

function keyOf(options: string, hash: string, { skeleton }: TakeInput): string {
  const parts = [options, hash, ...(skeleton ? [hashOfGiven(skeleton)] : [])];
  return createHash('sha256').update(parts.join('\n')).digest('hex').slice(0, 32);
}

/** A record for each take that the input has, or why it has none. @throws CommandError */
async function takesOf(
  input: TakeInput,
  { hash, key, bytes: content }: Identity,
  { settings, target, pool, parts }: Exporter,
): Promise<Pick<ExportResult, 'records' | 'skipped'>> {
  const begun = performance.now();
  const { path, skeleton } = input;
  const files = [...(skeleton ? [skeleton] : []), { ...input, ...(content && { bytes: content }) }];
  const loaded = atKnownRate(await loadFound(files, settings.folder, settings.parts), settings.rate);
  const { document, diagnostics } = openLoaded(loaded);
  const error = diagnostics.find(({ severity }) => severity === 'error');
  if (error) throw new CommandError(sentenceOf(error));
  const unread = loaded.broken.length > 0 && diagnostics.find(({ code }) => code === 'format-unknown');
  if (unread) return { records: [], skipped: unread.message };
  // The file of its skeleton may have takes of its own.
  const isOwn = ({ parts }: Character, i: number) => !skeleton || parts?.takes[i]?.file?.source.path === path;
  const takes = document.characters.flatMap((c) =>
    c.takes.flatMap((_, i) => (isOwn(c, i) ? [{ ...inSpaceOf(c, target.spaces), shownTake: i }] : [])),
  );
  if (takes.length === 0) throw new CommandError('It has no motion: no frames and no keys.');
  if (takes.some((take) => !take.skeleton)) {
    throw new CommandError('An animation alone has no joints. Its skeleton must be among the files.');
  }
  const told = (wanted: Severity) => diagnostics.filter(({ severity }) => severity === wanted).map(sentenceOf);
  const [warnings, notes] = [told('warning'), told('info')];
  const beside = loaded.files
    .flatMap((file) => file.beside ?? [])
    .map(({ path: part }): PartHash => {
      const given = parts.get(part) ?? { absolute: resolve(settings.folder, part) };
      return { path: part, hash: hashOfGiven(given) };
    });
  const records: WrittenTake[] = [];
  let since = begun;
  for (const [i, character] of takes.entries()) {
    const stem = takes.length > 1 ? `${input.stem}.${i + 1}` : input.stem;
    const options = { ...settings, ...(target.retargetOf && { target: target.retargetOf(character) }) };
    const take = takeOf(character, options);
    const { to } = settings;
    const check = settings.isChecked && !isMotion(to) ? checkOf(take, character) : undefined;
    const made = isMotion(to)
      ? await motionFiles(character, to, options)
      : FORMATS[to].write(
          takeArrays(take, pool, check),
          metaOf({ source: character, input, hash, notes }, take, settings),
        );
    const { output, bytes } = writeTake(stem, made, settings);
    const now = performance.now();
    records.push({
      ...{ input: input.path, hash, ...(beside.length > 0 && { beside }), output, bytes },
      ...{ frames: take.count, fps: take.fps, joints: take.skeleton.joints.length },
      ...(settings.isChecked && { flags: check?.end().map(flagText) ?? flagsOf(take, character) }),
      ...(warnings.length > 0 && { warnings }),
      ...(notes.length > 0 && { notes }),
      key,
      ...(settings.isTimed && { ms: Math.round(now - since) }),
    });
    since = now;
  }
  return { records };
}

/** In one line, without the file's name: `Line 128: Expected 3069 frames as declared, found 3070. (used 3070)` */
function sentenceOf({ line, message, assumed }: Diagnostic): string {
  return `${line > 0 ? `Line ${line}: ` : ''}${message}${assumed === undefined ? '' : ` (${assumed})`}`;
}

/** @throws CommandError if it can't be written */
function writeTake(
  stem: string,
  files: readonly ExportedFile[],
  { out, scratch, replaces }: ExportSettings,
): Pick<WrittenTake, 'output' | 'bytes'> {
  const named = files.map(({ ending, pieces }) => ({ name: `${stem}.${ending}`, pieces }));
  let bytes = 0;
  // What is beside comes first: an output that is there is complete.
  for (const { name, pieces } of named.toReversed()) {
    const path = join(out, name);
    if (!replaces && existsSync(path)) {
      throw new CommandError(`${name} already exists. Use --resume to continue an export, --force to overwrite.`);
    }
    const written = writeInFolder(path, pieces, scratch);
    if ('failure' in written) throw new CommandError(`${name} could not be written: ${written.failure}.`);
    bytes = written.bytes;
  }
  return { output: named[0].name, bytes };
}
