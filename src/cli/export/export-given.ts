/** Exports takes as the arguments of a command say: of `export`, and of `convert` with many files. */
import { mkdirSync } from 'node:fs';
import { resolve } from 'node:path';
import { CommandError } from '../../edit/command-error.ts';
import type { CommandIo, ExitCode } from '../io.ts';
import type { OptionValues } from '../options/option.ts';
import { findGiven } from '../paths.ts';
import { reasonOf } from '../reason.ts';
import { printJson } from '../report.ts';
import { UsageError } from '../usage-error.ts';
import { exportTakes } from './export-takes.ts';
import { inputsOf } from './inputs.ts';
import type { ExportSettings } from './settings.ts';
import { type EDITING, editingOf, type SHARING } from './switches.ts';
import { loadTarget } from './target.ts';
import { timeLeft } from './time-left.ts';

/** What the commands say differently. */
export type OwnSettings = Pick<ExportSettings, 'to' | 'precision' | 'isRaw' | 'isChecked' | 'tolerance'>;

/** More of what was assumed is in the manifest alone. */
const MAX_NOTES = 8;

/** The options that the commands share. */
export interface ExportOptions extends OptionValues<typeof EDITING>, OptionValues<typeof SHARING> {
  readonly out: string;
  readonly fps: number | undefined;
  readonly force: boolean;
  readonly json: boolean;
}

/** @param given files and folders, as arguments @throws UsageError before anything is written */
export async function exportGiven(
  given: readonly string[],
  options: ExportOptions,
  io: CommandIo,
  own: OwnSettings,
): Promise<ExitCode> {
  try {
    return await exportAll(given, options, io, own);
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    io.progress?.('');
    io.err(`marrow: ${error.message}\n`);
    return 1;
  }
}

/** @throws UsageError if it can't be made, as where there is a file of this name */
function makeFolder(out: string, folder: string): void {
  try {
    mkdirSync(resolve(folder, out), { recursive: true });
  } catch (error) {
    throw new UsageError(`--out takes a folder; ${out} is not one and could not be created: ${reasonOf(error)}.`);
  }
}

async function exportAll(
  given: readonly string[],
  options: ExportOptions,
  io: CommandIo,
  own: OwnSettings,
): Promise<ExitCode> {
  const { out, fps, force, json, retarget, map, space, shard, jobs: threads, resume: resumes } = options;
  const editing = editingOf(options);
  const { inputs, parts } = await inputsOf(given, options, io);
  // Also by each thread; here so that a wrong file is told before anything is written.
  await loadTarget(editing, io.folder);
  makeFolder(out, io.folder);
  const left = timeLeft();
  const summary = await exportTakes(
    {
      settings: {
        ...editing,
        ...own,
        ...{ folder: io.folder, out: resolve(io.folder, out), parts },
        ...(fps !== undefined && { fps }),
        replaces: resumes || force,
        isTimed: !options['no-times'],
      },
      ...{ inputs, shard, resumes, threads },
      dependsOn: findGiven(
        [...retarget, map, space].filter((path) => path !== undefined),
        io.folder,
      ).files.map(({ absolute }) => absolute),
    },
    io.program,
    (done, of, failed) => io.progress?.(progressText(done, of, failed, left(done, of))),
  );
  io.progress?.('');
  const { written, kept, bytes, warned, notes, failures, skipped, stale } = summary;
  for (const { input, error } of failures) io.err(`${input}: ${error}\n`);
  for (const why of new Set(skipped.map((each) => each.why))) {
    const names = skipped.filter((each) => each.why === why).map(({ input }) => input);
    io.err(`${counted(names.length, 'file')} skipped (${few(names)}): ${why}\n`);
  }
  for (const { note, takes } of notes.slice(0, MAX_NOTES)) io.err(`${counted(takes, 'take')}: ${note}\n`);
  if (notes.length > MAX_NOTES) {
    io.err(`${counted(notes.length - MAX_NOTES, 'more note')} of this kind are in the manifest.\n`);
  }
  if (stale.length > 0) {
    const [verb, s] = stale.length === 1 ? ['is', ''] : ['are', 's'];
    io.err(
      `marrow: ${stale.length} output${s} from earlier runs ${verb} no longer listed but still exist${verb === 'is' ? 's' : ''}: ${few(stale)}.\n`,
    );
  }
  // A command that did nothing has failed; other parts may have takes.
  const isVain = skipped.length > 0 && written + kept === 0 && !shard;
  if (json) await printJson(summary, io);
  else {
    const part = shard ? `part ${shard.index} of ${shard.count}: ` : '';
    const nothing = written === 0 && failures.length === 0 && !isVain;
    const sentence = nothing
      ? `nothing to do: ${counted(kept, 'take')} already exported`
      : [
          `${counted(written, 'take')} exported, ${megabytes(bytes)}`,
          ...(kept > 0 ? [`${number(kept)} unchanged`] : []),
          ...(warned > 0 ? [`${number(warned)} with warnings, in the manifest`] : []),
          ...(failures.length > 0 ? [`${number(failures.length)} failed`] : []),
        ].join('; ');
    await io.out(`${out}: ${part}${sentence}\n`);
  }
  return failures.length > 0 || isVain ? 1 : 0;
}

function progressText(done: number, of: number, failed: number, left: string): string {
  return `${number(done)} of ${number(of)}${failed > 0 ? `, ${number(failed)} failed` : ''}${left && `, ${left} left`}`;
}

function number(value: number): string {
  return value.toLocaleString('en');
}

function counted(count: number, noun: string): string {
  return `${number(count)} ${noun}${count === 1 ? '' : 's'}`;
}

function megabytes(bytes: number): string {
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}

/** The first few of a list. */
function few(names: readonly string[]): string {
  return names.length > 3 ? `${names.slice(0, 3).join(', ')} and ${names.length - 3} more` : names.join(', ');
}
