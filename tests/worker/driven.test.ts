/** Characters that are retargeted, and those that follow one, as the worker gets them: it has loaded no code for that. */
import { beforeEach, expect, it } from 'vitest';
import { addAttachment } from '../../src/edit/commands/beside/attach.ts';
import { setRetarget } from '../../src/edit/commands/retarget.ts';
import { provideDrivenPose } from '../../src/evaluate/driven-pose.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { ownedIn } from '../../src/files/save/owned.ts';
import { EMPTY_DOCUMENT, findCharacter } from '../../src/model/document.ts';
import { changesOf } from '../../src/worker/changes.ts';
import { exchangeFileOf } from '../../src/worker/exchange.ts';
import { parsed } from '../helpers/parsed.ts';

const SKEL = 'balljoint a {\n\toffset 0 0 0\n\tballjoint b {\n\t\toffset 0 1 0\n\t}\n}\n';
/** Nine channels, of which all but the last move in a second. */
const anim = (last: number) => {
  const channel = (value: number) =>
    `channel {\nextrapolate constant constant\nkeys 2 {\n0 0 smooth smooth\n1 ${value} smooth smooth\n}\n}\n`;
  return `animation {\nrange 0 1\nnumchannels 9\n${[0, 0, 0, 0, 0, 0, 0, 0, last].map(channel).join('')}}\n`;
};

function followers() {
  const names = ['source', 'target', 'sword'];
  const { document } = openFiles(
    EMPTY_DOCUMENT,
    names.flatMap((name) => [
      parsed(`${name}.skel`, SKEL),
      parsed(`${name}_move.anim`, anim(name === 'source' ? 1 : 0)),
    ]),
  );
  const [source, target, sword] = document.characters.map(({ id }) => id);
  const driven = setRetarget.run(document, { characterId: target, sourceId: source });
  const attached = addAttachment.run(driven, { characterId: sword, leaderId: target, joint: 1, span: [0, 1] });
  const get = (id: string) => {
    const found = findCharacter(attached, id);
    if (!found) throw new Error(`no ${id}`);
    return found;
  };
  return { target: get(target), sword: get(sword), document: attached };
}

const made = followers();
const OPTIONS = { keys: 'linear', body: true } as const;
const nobody = () => undefined;

beforeEach(() => {
  provideDrivenPose(() => {
    throw new Error('not provided');
  });
});

it.each(['target', 'sword'] as const)('the worker writes the %s as GLB and FBX', async (name) => {
  for (const format of ['glb', 'fbx'] as const) {
    const { report } = await exchangeFileOf(
      { format, character: structuredClone(made[name]), options: OPTIONS },
      nobody,
    );
    expect(report.bytes).toBeGreaterThan(1000);
  }
});

it('the worker tells what has changed in the plain file of one that follows it', async () => {
  const text = anim(0);
  const source = { name: 'sword_move.anim', path: 'sword_move.anim', bytes: text.length };
  const owned = structuredClone(ownedIn(made.document, source.path, () => []));
  expect(owned).toHaveLength(1);
  const { hunks } = await changesOf({ file: { path: source.path, blob: new Blob([text]) }, source, owned });
  expect(hunks.length).toBeGreaterThan(0);
});
