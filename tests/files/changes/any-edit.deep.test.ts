/** What any edits changed in real files: the text is the file with the hunks, and reads as what saving writes. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { ALL_COMMANDS } from '../../../src/edit/commands/all.ts';
import { Store } from '../../../src/edit/store.ts';
import { changedText, rewritten } from '../../../src/files/changes/changed-text.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { formatOf } from '../../../src/files/readers.ts';
import { savedFileOf } from '../../../src/files/save/output.ts';
import { ownedIn } from '../../../src/files/save/owned.ts';
import { jointPose } from '../../../src/files/save/saved-poses.ts';
import { writeParts } from '../../../src/files/save/saving.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { FileContent, ParsedFile } from '../../../src/model/files.ts';
import { anyCommand, argumentsFor, COMMANDS_HERE } from '../../edit/any-command.ts';
import { Dice, thrown } from '../../edit/dice.ts';
import { fileBytes } from '../../formats/shared-files.ts';
import { bvhBytes } from '../../helpers/bvh-files.ts';
import { hasShared } from '../../helpers/shared.ts';
import { applyHunks } from './apply-hunks.ts';

/** Files that are opened together. */
const SETS = [
  ['own/cube.skel', 'own/cube_spin.anim'],
  ['own/tangents.skel', 'own/tangents.skin'],
  ['own/crawler.skel', 'own/crawler_walk.anim'],
  ['own-walk.bvh'],
];

const REFERENCE_SETS = [
  ['data/cse169/wasp.skel', 'data/cse169/wasp.skin', 'data/cse169/wasp_walk.anim'],
  ['data/cse169/dragon.skel'],
  ['data/synthetic/nine.skel', 'data/synthetic/nine.skin'],
  ['data/axis-skel/hexapod.axskel'],
  ['data/bvh/dialect-rows.bvh'],
  ['data/bvh/poser-sl-walk.bvh'],
];

interface Given {
  readonly file: ParsedFile;
  readonly text: string;
}

function given(path: string): Given {
  const name = path.slice(path.lastIndexOf('/') + 1);
  const text = new TextDecoder().decode(path.endsWith('.bvh') ? bvhBytes(name) : fileBytes(path));
  const format = formatOf(name);
  const { value } = format ? readWhole<FileContent>(format.reader(name), text) : {};
  if (!value) throw new Error(`${path} can't be read.`);
  return { file: { ...value, source: { name, path, bytes: text.length } }, text };
}

describe('what any edits changed in files', () => {
  const sets = [...SETS, ...(hasShared ? REFERENCE_SETS : [])].map((paths) => paths.map(given));
  /** Often of the rig, which changes more than single numbers. */
  const command = fc.oneof(fc.constantFrom(...COMMANDS_HERE.filter((id) => id.startsWith('rig.'))), anyCommand);
  const steps = fc.array(fc.tuple(command, thrown), { minLength: 1, maxLength: 4 });
  it('is a text that reads as what saving writes, and the hunks lead to it', async () => {
    await fc.assert(
      fc.asyncProperty(fc.nat(sets.length - 1), steps, async (set, commands) => {
        const files = sets[set];
        const store = new Store(
          openFiles(
            EMPTY_DOCUMENT,
            files.map(({ file }) => file),
          ).document,
        );
        store.select({ characterId: store.document.characters[0].id, joint: 0 });
        for (const [id, throws] of commands) {
          const command = ALL_COMMANDS.get(id);
          const args = command && argumentsFor(id, store, new Dice(throws));
          try {
            if (command && args) store.apply(command, args as never);
          } catch (error) {
            if (!(error instanceof CommandError)) throw error;
          }
          if (store.document.characters.length === 0) return;
        }
        for (const {
          file: { source },
          text,
        } of files) {
          const owned = ownedIn(store.document, source.path, jointPose);
          if (owned.length === 0) continue;
          const after = savedFileOf(writeParts(source.name, owned)).text;
          const changed = await changedText(source, text, owned);
          // What can't be merged is the written text.
          if (changed.text !== after) expect(applyHunks(text, changed)).toBe(changed.text);
          const again = await rewritten(source, changed.text, owned);
          expect(again).toBe(after);
        }
      }),
      { numRuns: 20 },
    );
  });
});
