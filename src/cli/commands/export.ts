/** `marrow export`: takes as arrays of numbers, a file each, for programs that learn from them. */
import { exportGiven } from '../export/export-given.ts';
import { FORMAT_NAMES } from '../export/formats.ts';
import { EDITING, SHARING } from '../export/switches.ts';
import { anyInputs } from '../options/inputs.ts';
import { ending, positive, text } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';

export const exportCommand = shellCommand({
  name: 'export',
  summary: 'Exports each take as a file of numeric arrays, with a manifest.',
  inputs: anyInputs(['PATHS…'], {
    PATHS: 'Motion capture, glTF, FBX, or skeletons with their animations: files, folders and zips.',
  }),
  options: {
    to: option(
      ending(FORMAT_NAMES),
      'Writes npz, numpy arrays; parquet or csv, one row per frame with the world position and quaternion of each joint, and the rest in the metadata or in a .json next to it; or json, all arrays as text.',
      { isRequired: true },
    ),
    out: option(
      text('DIR', 'the folder for the exported files'),
      'Writes to this folder, which is created if missing.',
      {
        isRequired: true,
      },
    ),
    fps: option(
      positive('N'),
      "Samples at this many frames per second instead of the take's own, or 60 for keys at uneven times.",
    ),
    float64: flag('Writes numbers in double precision instead of single.'),
    raw: flag(
      "Keeps the file's unit, axes and origin instead of metres, y up, on the ground (stated by the file or guessed).",
    ),
    force: flag('Overwrites existing files.'),
    'no-checks': flag('Leaves the flags out of the manifest; the checks take about a fifth of the time.'),
    json: flag('Prints the summary as JSON.'),
    ...EDITING,
    ...SHARING,
  },
  about: [
    'Each take becomes `DIR/PATH.npz`, where PATH is relative to the folder you name or, if two takes would collide, to the folder that all share; several takes in one file become `PATH.1.npz`, `PATH.2.npz`. Those in `walks.zip` are in `DIR/walks`. `DIR/manifest.ndjson` has a line for each.',
  ],
  examples: ['marrow export takes/ --only list.csv --to npz --out dataset/'],
  exits: { 0: 'all takes were exported', 1: 'some takes failed; the manifest lists them', 2: 'wrong usage' },
  run({ inputs, options }, io) {
    return exportGiven(inputs, options, io, {
      to: options.to,
      precision: options.float64 ? 'float64' : 'float32',
      isRaw: options.raw,
      isChecked: !options['no-checks'],
    });
  },
});
