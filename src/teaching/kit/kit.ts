/** The test kit: its files, their answers for programs and for people, and how to use them. */
import { DEFAULT_TOLERANCE } from '../compare/errors.ts';
import { type SetAnswers, setAnswers } from './answers.ts';
import { kitFiles } from './files.ts';
import { readme } from './readme.ts';

/** All files of the kit by name: `tree.skel`, `answers.json`, `answers.txt`, `README.md` … */
export function testKit(): ReadonlyMap<string, string> {
  const sets = setAnswers();
  return new Map([
    ...kitFiles(),
    ['answers.json', answersJson(sets)],
    ['answers.txt', answersText(sets)],
    ['README.md', readme(sets)],
  ]);
}

/** Lists of numbers are on one line each. */
function answersJson(sets: readonly SetAnswers[]): string {
  const about =
    'Double precision, angles in radians. world and local: 16 numbers, column-major; the last four are the position, x y z 1. ' +
    'A frame without a time is the file pose.';
  const text = JSON.stringify({ about, tolerance: DEFAULT_TOLERANCE, sets }, null, 1);
  return `${text.replace(/\[\n([-+\d.e,\s]+?)\n *\]/g, (_, list: string) => `[${list.trim().replace(/\s+/g, ' ')}]`)}\n`;
}

/** For languages without JSON: `SET TIME KIND INDEX NUMBERS…`, `pose` for the time of the file pose. */
function answersText(sets: readonly SetAnswers[]): string {
  const lines: string[] = ['# set time kind index numbers'];
  for (const { name, frames = [], channels } of sets) {
    for (const { time = 'pose', joints, vertices = [], normals = [] } of frames) {
      const add = (kind: string, index: number, numbers: readonly number[]) =>
        lines.push([name, time, kind, index, ...numbers].join(' '));
      for (const [j, { world }] of joints.entries()) add('world', j, world);
      for (const [j, { local }] of joints.entries()) add('local', j, local);
      for (const [v, position] of vertices.entries()) add('vertex', v, position);
      for (const [v, normal] of normals.entries()) add('normal', v, normal);
    }
    channels?.values.forEach((values, c) => {
      values.forEach((value, i) => void lines.push([name, channels.times[i], 'channel', c, value].join(' ')));
    });
  }
  return `${lines.join('\n')}\n`;
}
