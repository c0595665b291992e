/** `marrow grade` of inverse kinematics: the target is stated by the submission, or by the reference's file. */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, expect, it } from 'vitest';
import type { Grade } from '../../src/cli/grade/grade.ts';
import { commandJson } from '../helpers/command.ts';
import { ARMS_TEXT, HAND, OTHER_HAND, reached, START, stepped, worldOf } from '../teaching/ik/student-arm.ts';

const TARGET = [0.4, 1.6, 1.1] as const;
const LINE = `target ${HAND}: ${TARGET.join(' ')}\n`;
const numbers = (angles: readonly number[]) => {
  const world = worldOf(angles);
  return Array.from({ length: world.length / 16 }, (_, j) => world.subarray(16 * j, 16 * j + 16).join(' ')).join('\n');
};

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-grade-ik-'));
  const write = (path: string, text: string) => {
    mkdirSync(join(folder, path, '..'), { recursive: true });
    writeFileSync(join(folder, path), text);
  };
  const solution = reached(HAND, TARGET);
  write('ref/arms.axskel', ARMS_TEXT);
  write('ref/ik.txt', LINE + numbers(solution));
  // The other arm is anywhere.
  write('class/ann/ik.txt', numbers(stepped(solution, [0, 0, 0, 0, 0.3, -0.4])));
  write('class/bob/ik.txt', LINE + numbers(reached(OTHER_HAND, TARGET)));
  write('class/cid/ik.txt', numbers(START));
});
afterAll(() => rmSync(folder, { recursive: true }));

it('any solution is right, and mistakes of solvers are named', async () => {
  const { submissions } = await commandJson<{ submissions: readonly Grade[] }>(
    ['grade', 'class', '--reference', 'ref'],
    folder,
  );
  expect(submissions.map(({ name, verdict }) => [name, verdict])).toEqual([
    ['ann', 'right'],
    ['bob', 'wrong'],
    ['cid', 'wrong'],
  ]);
  const [, [bob], [cid]] = submissions.map(({ parts }) => parts);
  expect(bob.causes).toMatchObject([{ code: 'ik-end-effector', detail: 'the tip of joint 5' }]);
  expect(cid.first).toMatchObject({ what: 'joint', index: HAND });
  expect(cid.unexplained.join(' ')).toContain('All joints are where they were before.');
});
