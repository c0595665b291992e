/** Random arguments for the command's subcommands: real ones, odd ones, out of order. */
import type { ShellCommand } from '../../../src/cli/options/shell-command.ts';

/** Of options, and names of files. None is an absolute path. */
export const ODD_VALUES: readonly string[] = [
  ...['', ' ', '-', '-1', '0', '-0', '1', '2', '0.5', '1e308', '-1e308', '1e-300', '1e400', 'NaN', 'Infinity', '0x10'],
  ...['1,2', '1,2,3', ',', '1,', ',1', '1,,2', '0,1e308', '2,1', '1e-300,1e308', '9007199254740993', '1/2', '2/1'],
  ...['1/99999999999999999999', '0/0', '1/4294967296', 'linear', 'cubic', '#0=0,1,0', 'root=1e308,0,0'],
  ...['tip@0,0,0=0,1e-300,0'],
  ...['tip=0,0,0,-1', '#99=0,0,0', '=', '@=', 'root=', '__proto__', 'constructor', 'a\nb', '\x1b[31mred\x07'],
  ...['\u009b31m', '\ud83d'],
  ...['a.skel', 'a.anim', 'dump.txt', 'takes', 'takes/t0.bvh', 'none.bvh', 'list.csv', 'paths.txt', '.', '..'],
  ...['class', 'right'],
  ...['new', 'new/deep/er', 'new.npz', 'new.glb', 'new.bvh', 'new.anim', 'new.skel', 'new.csv', 'a.skel/new'],
  ...['x'.repeat(5000)],
  ...['npz', 'parquet', 'csv', 'json', 'skel', 'anim', 'bvh', 'rig', '.NPZ', '--json', '--', '--help=1', '-h'],
];

/** @param below draws a whole number from 0 to below its argument */
export function randomArguments({ name, options }: ShellCommand, below: (count: number) => number): string[] {
  const names = Object.keys(options);
  const pick = <T>(items: readonly T[]): T => items[below(items.length)];
  const args = [name];
  // Half of them begin with what the subcommand needs, so that it comes to read its options.
  if (below(2) === 0) args.push(...pick(NEEDED[name] ?? [[]]));
  const count = below(6);
  for (let i = 0; i < count; i++) {
    const option = `--${pick(names)}`;
    const kind = below(10);
    if (kind < 3) args.push(option, pick(ODD_VALUES));
    else if (kind < 5) args.push(`${option}=${pick(ODD_VALUES)}`);
    else if (kind < 6) args.push(option);
    else if (kind < 9) args.push(pick(ODD_VALUES));
    else
      args.push(
        pick(['--', '--x', '-x', '---', '--=', '--json=1', '--__proto__', '--toString', `--${'y'.repeat(3000)}`]),
      );
  }
  return args;
}

/** Arguments that subcommands can't do without. */
const NEEDED: Readonly<Record<string, readonly (readonly string[])[]>> = {
  info: [['a.skel'], ['takes']],
  pose: [['a.skel', 'a.anim'], ['takes/t0.bvh']],
  ik: [['a.skel', '--pin', 'tip=0,1,1']],
  channels: [['a.anim', '--times', '0,1']],
  compare: [['a.skel', 'dump.txt']],
  grade: [['class', '--reference', 'right']],
  kit: [['new-kit']],
  convert: [
    ['takes', '--to', 'anim', '--out', 'new'],
    ['takes/t0.bvh', 'new.anim'],
    ['a.skel', 'a.anim', 'new.glb'],
    ['takes', '--to', 'bvh', '--out', 'new', '--jobs', '1'],
  ],
  export: [
    ['takes', '--to', 'npz', '--out', 'new'],
    ['a.skel', 'a.anim', '--to', 'csv', '--out', 'new', '--force'],
    ['takes', '--to', 'json', '--out', 'new', '--resume'],
  ],
  review: [['takes'], ['takes', '--list', 'list.csv'], ['takes', '--out', 'new.csv']],
};
