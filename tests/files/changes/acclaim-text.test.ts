/** Texts of Acclaim as Source shows and edits them: a motion is read with the skeleton of its character. */
import { expect, it } from 'vitest';
import { changedText } from '../../../src/files/changes/changed-text.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { ownedIn } from '../../../src/files/save/owned.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { checkText } from '../../../src/worker/changes.ts';
import { ODD_AMC, ODD_ASF, readAmcText, readAsfText } from '../../helpers/acclaim.ts';

const SKELETON = { name: 'x.asf', path: 'cmu/x.asf', bytes: ODD_ASF.length };
const MOTION = { name: 'x_walk.amc', path: 'cmu/x_walk.amc', bytes: ODD_AMC.length };

it('a skeleton and a motion have no changes as opened, and an edited motion is read with its skeleton', async () => {
  const [asf, amc] = [(await readAsfText(ODD_ASF)).value, (await readAmcText(ODD_AMC)).value];
  if (!asf || !amc) throw new Error('They were not read.');
  const { document } = openFiles(EMPTY_DOCUMENT, [
    { ...asf, source: SKELETON },
    { ...amc, source: MOTION, of: SKELETON },
  ]);
  const ownedOf = (path: string) => ownedIn(document, path, () => []);
  await expect(changedText(SKELETON, ODD_ASF, ownedOf(SKELETON.path))).resolves.toEqual({ text: ODD_ASF, hunks: [] });
  await expect(changedText(MOTION, ODD_AMC, ownedOf(MOTION.path))).resolves.toEqual({ text: ODD_AMC, hunks: [] });

  const check = (edited: string) =>
    checkText({ source: MOTION, edited, base: ODD_AMC, owned: ownedOf(MOTION.path) }, () => undefined);
  const edited = await check(ODD_AMC.replace('low 0.2', 'low 0.7'));
  expect([edited.isSame, edited.diagnostics]).toEqual([false, []]);
  expect(edited.files).toMatchObject([{ kind: 'amc', of: { path: SKELETON.path } }]);
  expect((await check(ODD_AMC.replace('low 0.2', 'low 0.20'))).isSame).toBe(true);
  expect((await check(ODD_AMC.replace('low 0.2', 'lov 0.2'))).diagnostics).toMatchObject([
    { code: 'bone-unknown', line: 12 },
  ]);
});
