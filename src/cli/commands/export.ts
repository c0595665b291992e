/** `marrow export`: takes as arrays of numbers, a file each, for programs that learn from them. */
import { resolve } from 'node:path';
import { CommandError } from '../../edit/store.ts';
import { parseArguments, UsageError } from '../arguments.ts';
import { exportTakes } from '../export/export-takes.ts';
import { type ExportFormat, FORMATS } from '../export/formats.ts';
import { inputsOf } from '../export/inputs.ts';
import { cropOf, jobsOf, positive, shardOf } from '../export/switches.ts';
import { loadTarget } from '../export/target.ts';
import { timeLeft } from '../export/time-left.ts';
import type { CliCommand, CommandIo, ExitCode } from '../io.ts';
import { printJson } from '../report.ts';

const NAMES = Object.keys(FORMATS);

export const exportCommand: CliCommand = {
  name: 'export',
  usage: `PATHS… --to ${NAMES.join('|')} --out DIR [options]`,
  summary: 'the takes of files and folders as arrays of numbers, a file each, with a manifest; options: export --help',
  details: `PATHS are motion capture, or skeletons with their animations. Each take becomes DIR/PATH.npz, at its path below
the folder that was named; several in one file become PATH.1.npz, PATH.2.npz. DIR/manifest.ndjson has a line for each.

what is exported
  --to FORMAT            npz: numpy arrays; parquet, csv: a row a frame, world positions and quaternions of each joint, the
                         rest in the file's metadata, or in a .json beside it; json: all arrays as text
  --out DIR              made if it is not there
  --float64              numbers in double precision; default: single
  --raw                  the file's own unit, axes and origin; default: metres, y up, on the ground, as guessed
  --space FILE           takes of the skeleton in FILE have its unit, up axis and ground; default: each its own guess

what is done before
  --retarget FILE        onto the skeleton in FILE
  --map FILE             joint pairs for it, lines "target,source"; default: matched by name and shape
  --fps N                frames per second; default: the take's own, or 60 for keys at uneven times
  --mirror               left and right exchanged, before --retarget
  --crop FROM,TO         seconds of the take; either may be left out

which takes, and where
  --only LIST            takes of a list, but for those with the verdict bad: CSV or JSON of a review, or plain paths;
                         without PATHS, the paths of the list
  --files-from FILE      paths from the lines of FILE, or of the standard input for -
  --shard I/N            part I of N: every N-th take; all parts may run at once, on any machine
  --jobs N               threads; default: as many as cores
  --resume               skips takes whose input, options and version are those of an earlier run
  --force                replaces files that exist
  --no-checks            leaves the flags out of the manifest; the checks take about as long as all the rest
  --no-times             leaves milliseconds out of the manifest: its bytes then depend on inputs and options only
  --json                 prints the summary as JSON
`,
  exits: { 0: 'all takes were exported', 1: 'some failed; they are listed', 2: 'wrong usage' },
  async run(args, io) {
    try {
      return await exportAll(args, io);
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      io.progress?.('');
      io.err(`marrow: ${error.message}\n`);
      return 1;
    }
  },
};

async function exportAll(args: readonly string[], io: CommandIo): Promise<ExitCode> {
  const given = parseArguments(args, {
    ...{ to: 'value', out: 'value', float64: 'flag', raw: 'flag', space: 'value' },
    ...{ retarget: 'value', map: 'value', mirror: 'flag', fps: 'value', crop: 'value' },
    ...{ only: 'value', 'files-from': 'value', shard: 'value', jobs: 'value' },
    ...{ resume: 'flag', force: 'flag', 'no-checks': 'flag', 'no-times': 'flag', json: 'flag' },
  });
  const to = formatOf(given.value('to'));
  const out = given.value('out');
  if (out === undefined) throw new UsageError('--out is missing: the folder for the exported files.');
  const [retarget, map, space] = ['retarget', 'map', 'space'].map((name) => given.value(name));
  if (map !== undefined && retarget === undefined) throw new UsageError('--map needs --retarget.');
  const files = {
    ...(retarget !== undefined && { retarget }),
    ...(map !== undefined && { map }),
    ...(space !== undefined && { space }),
  };
  const fps = positive(given, 'fps');
  const crop = cropOf(given);
  const [shard, threads] = [shardOf(given), jobsOf(given)];
  const resumes = given.flag('resume');
  const inputs = await inputsOf(given, io);
  // Also by each thread; here so that a wrong file is told before anything is written.
  loadTarget(files, io.folder);
  const left = timeLeft();
  const summary = await exportTakes(
    {
      settings: {
        ...files,
        ...{ folder: io.folder, out: resolve(io.folder, out), to },
        precision: given.flag('float64') ? 'float64' : 'float32',
        isRaw: given.flag('raw'),
        isMirrored: given.flag('mirror'),
        ...(fps !== undefined && { fps }),
        ...(crop && { crop }),
        replaces: resumes || given.flag('force'),
        isChecked: !given.flag('no-checks'),
        isTimed: !given.flag('no-times'),
      },
      ...{ inputs, shard, resumes, threads },
      dependsOn: Object.values(files).map((path) => resolve(io.folder, path)),
    },
    io.program,
    (done, of, failed) => io.progress?.(progressText(done, of, failed, left(done, of))),
  );
  io.progress?.('');
  const { written, kept, bytes, warned, failures, stale } = summary;
  for (const { input, error } of failures) io.err(`${input}: ${error}\n`);
  if (stale.length > 0) {
    const [verb, s] = stale.length === 1 ? ['is', ''] : ['are', 's'];
    io.err(
      `marrow: ${stale.length} output${s} of earlier runs ${verb} no longer listed, and ${verb} still there: ${few(stale)}.\n`,
    );
  }
  if (given.flag('json')) await printJson(summary, io);
  else {
    const part = shard ? `part ${shard.index} of ${shard.count}: ` : '';
    const nothing = written === 0 && failures.length === 0;
    const sentence = nothing
      ? `nothing to do, all ${counted(kept, 'take')} ${kept === 1 ? 'is' : 'are'} exported`
      : [
          `${counted(written, 'take')} exported, ${megabytes(bytes)}`,
          ...(kept > 0 ? [`${number(kept)} unchanged`] : []),
          ...(warned > 0 ? [`${number(warned)} with warnings, in the manifest`] : []),
          ...(failures.length > 0 ? [`${number(failures.length)} failed`] : []),
        ].join('; ');
    await io.out(`${out}: ${part}${sentence}\n`);
  }
  return failures.length > 0 ? 1 : 0;
}

function formatOf(text: string | undefined): ExportFormat {
  const known = NAMES.join(', ');
  if (text === undefined) throw new UsageError(`--to is missing: one of ${known}.`);
  const name = text.replace(/^\./, '').toLowerCase();
  const isFormat = (each: string): each is ExportFormat => Object.hasOwn(FORMATS, each);
  if (!isFormat(name)) throw new UsageError(`--to takes one of ${known}, found "${text}".`);
  return name;
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
