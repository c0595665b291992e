/** `marrow export`: takes as arrays of numbers, a file each, for programs that learn from them. */
import { parseArguments, UsageError } from '../arguments.ts';
import { exportGiven } from '../export/export-given.ts';
import { type ExportFormat, FORMATS } from '../export/formats.ts';
import { EDITING, SHARING } from '../export/switches.ts';
import type { CliCommand } from '../io.ts';

const NAMES = Object.keys(FORMATS);

export const exportCommand: CliCommand = {
  name: 'export',
  usage: `PATHS… --to ${NAMES.join('|')} --out DIR [options]`,
  summary: 'the takes of files and folders as arrays of numbers, a file each, with a manifest; options: export --help',
  details: `PATHS are motion capture, glTF, FBX, or skeletons with their animations. Each take becomes DIR/PATH.npz, at its path below
the folder that was named, or, where that would be the same for two, below the folder that all share; several in one file
become PATH.1.npz, PATH.2.npz. Those in walks.zip are in DIR/walks. DIR/manifest.ndjson has a line for each.

what is exported
  --to FORMAT            npz: numpy arrays; parquet, csv: a row a frame, world positions and quaternions of each joint, the
                         rest in the file's metadata, or in a .json beside it; json: all arrays as text
  --out DIR              made if it is not there
  --float64              numbers in double precision; default: single
  --raw                  the file's own unit, axes and origin; default: metres, y up, on the ground, as the file states
                         or as guessed
  --space FILE           takes of the skeleton in FILE have its unit, up axis and ground; default: each its own

what is done before
  --retarget FILE        onto the skeleton in FILE, a folder or zip too
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
  --no-checks            leaves the flags out of the manifest; the checks take about a fifth of the time
  --no-times             leaves milliseconds out of the manifest: its bytes then depend on inputs and options only
  --json                 prints the summary as JSON
`,
  exits: { 0: 'all takes were exported', 1: 'some failed; they are listed', 2: 'wrong usage' },
  async run(args, io) {
    const given = parseArguments(args, {
      ...{ to: 'value', out: 'value', float64: 'flag', raw: 'flag', fps: 'value' },
      ...{ force: 'flag', 'no-checks': 'flag', json: 'flag' },
      ...EDITING,
      ...SHARING,
    });
    const to = formatOf(given.value('to'));
    return exportGiven(given, io, {
      to,
      precision: given.flag('float64') ? 'float64' : 'float32',
      isRaw: given.flag('raw'),
      isChecked: !given.flag('no-checks'),
    });
  },
};

function formatOf(text: string | undefined): ExportFormat {
  const known = NAMES.join(', ');
  if (text === undefined) throw new UsageError(`--to is missing: one of ${known}.`);
  const name = text.replace(/^\./, '').toLowerCase();
  const isFormat = (each: string): each is ExportFormat => Object.hasOwn(FORMATS, each);
  if (!isFormat(name)) throw new UsageError(`--to takes one of ${known}, found "${text}".`);
  return name;
}
