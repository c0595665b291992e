/** The lines of an Acclaim motion: those of a bone are its joint's, in each frame, whatever order the frames have. */
import { expect, it } from 'vitest';
import { openFiles } from '../../../../src/files/open/open-files.ts';
import { mapSource } from '../../../../src/formats/source/map-source.ts';
import { EMPTY_DOCUMENT } from '../../../../src/model/document.ts';
import { linesOf, targetAt } from '../../../../src/model/source-map.ts';
import { partsFrom, pickOf, targetsOf } from '../../../../src/ui/editors/source/places.ts';
import { bytesOf } from '../../../formats/read-in-pieces.ts';
import { ODD_AMC, ODD_ASF, readAmcText, readAsfText } from '../../../helpers/acclaim.ts';

const SKELETON = { name: 'x.asf', path: 'x.asf', bytes: ODD_ASF.length };
const MOTION = { name: 'x_walk.amc', path: 'x_walk.amc', bytes: ODD_AMC.length };
/** The frames above on lines 5 and 10; then one in another order, with a bone left out, and one with a gap. */
const AMC = `${ODD_AMC}3\nlow 0 0 0\n# a comment\nROOT 0 0 0 0 0 0\n4\nlow 0 0 0\n\nroot 0 0 0 0 0 0\n5\nlow 0 0 0\n\nroot 0 0 0 0 0 0\n`;

async function opened() {
  const [asf, amc] = [(await readAsfText(ODD_ASF)).value, (await readAmcText(AMC)).value];
  if (!asf || !amc) throw new Error('They were not read.');
  const { document } = openFiles(EMPTY_DOCUMENT, [
    { ...asf, source: SKELETON },
    { ...amc, source: MOTION, of: SKELETON },
  ]);
  return { document, map: mapSource(bytesOf(AMC), MOTION.name), parts: partsFrom(document, MOTION.path) };
}

it('a selected joint has the line of its bone in each frame', async () => {
  const { document, map, parts } = await opened();
  const [{ id, skeleton }] = document.characters;
  const lines = AMC.split('\n');
  const textOf = (name: string) => {
    const joint = skeleton?.joints.findIndex((each) => each.name === name) ?? -1;
    const targets = parts.flatMap((own) => targetsOf(own, { characterId: id, joint }, undefined));
    return targets.flatMap((target) => linesOf(map, target)).flatMap(({ from, to }) => lines.slice(from - 1, to));
  };
  expect(textOf('rod')).toEqual(['rod 0.5 0.25', 'rod -0.5 -0.125']);
  expect(textOf('low')).toEqual(['low 0.1 0.2 0.3', 'low 0.2 0.1 -0.3', 'low 0 0 0', 'low 0 0 0', 'low 0 0 0']);
  expect(textOf('root')).toHaveLength(5);
  expect(textOf('stick')).toEqual([]);
});

it('a line of a bone selects its joint and goes to its frame; that of a number goes to the frame', async () => {
  const { document, map, parts } = await opened();
  const [{ id, skeleton }] = document.characters;
  const picked = (line: number) => {
    const target = targetAt(map, line);
    return target && pickOf(parts, target);
  };
  AMC.split('\n').forEach((text, i) => {
    const [word] = text.split(' ');
    const joint = skeleton?.joints.findIndex((each) => each.name === word.toLowerCase()) ?? -1;
    if (i >= 4 && joint >= 0) expect(picked(i + 1)?.selection, `line ${i + 1}`).toEqual({ characterId: id, joint });
  });
  expect(picked(12)).toMatchObject({ text: 'low in frame 1', timeSeconds: 1 / 60 });
  expect(picked(10)).toMatchObject({ text: 'Frame 1', selection: { characterId: id } });
  expect(picked(3)).toBeUndefined();
});

it('frames with their bones in the same lines are one block, however many there are', () => {
  const frames = Array.from({ length: 500 }, (_, f) => `${f + 1}\nroot 1 2 3 4 5 6\nlow ${f} 0 0\n`).join('');
  const { rows } = mapSource(bytesOf(`:DEGREES\n${frames}`), 'a.amc');
  expect(rows).toMatchObject([{ of: 'frame', first: 0, bones: ['root', 'low'] }]);
  expect(rows[0].lines.rows).toHaveLength(1);
});
