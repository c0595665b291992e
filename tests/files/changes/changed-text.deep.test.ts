import { describe, expect, it } from 'vitest';
import { addKey, moveKeys } from '../../../src/edit/commands/keys.ts';
import { addJoint, removeJoint } from '../../../src/edit/commands/rig.ts';
import { Store } from '../../../src/edit/store.ts';
import { changedText, rewritten } from '../../../src/files/changes/changed-text.ts';
import type { MergedText } from '../../../src/files/changes/merge.ts';
import { splitLines } from '../../../src/files/changes/text-lines.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { savedFileOf } from '../../../src/files/save/output.ts';
import { ownedIn } from '../../../src/files/save/owned.ts';
import { jointPose } from '../../../src/files/save/saved-poses.ts';
import { writeParts } from '../../../src/files/save/saving.ts';
import { mapSource } from '../../../src/formats/source/map-source.ts';
import { type Character, type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { ParsedFile } from '../../../src/model/files.ts';
import { linesOf, type SourceTarget } from '../../../src/model/source-map.ts';
import type { LineHunk } from '../../../src/model/text-changes.ts';
import { bytesOf } from '../../formats/read-in-pieces.ts';
import { realFiles } from '../../formats/real-files.ts';
import { parsed } from '../../helpers/parsed.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { applyHunks } from './apply-hunks.ts';

const textOf = (path: string) => new TextDecoder().decode(sharedBytes(path));

/** What files of a kind belong to. */
const BESIDE: Readonly<Record<string, string>> = {
  morph: 'data/cse169/head.skin',
  pose: 'data/cse169/wasp.skel',
  anim: 'data/cse169/wasp.skel',
};

class Opened {
  readonly file: ParsedFile;
  readonly document: Document;

  constructor(
    path: string,
    readonly text: string,
  ) {
    this.file = parsed(path, text);
    const beside = BESIDE[/[^.]*$/.exec(path)?.[0] ?? ''];
    const others = beside === undefined ? [] : [parsed(beside, textOf(beside))];
    const { document } = openFiles(EMPTY_DOCUMENT, [...others, this.file]);
    this.document =
      ownedIn(document, path, jointPose).length > 0 ? document : openFiles(EMPTY_DOCUMENT, [this.file]).document;
  }

  /** The file's text with what an edit changed. */
  changed(edit: (character: Character) => Character): Promise<MergedText> {
    return this.changedIn({ ...this.document, characters: this.document.characters.map(edit) });
  }

  async changedIn(document: Document): Promise<MergedText> {
    const { source } = this.file;
    const owned = ownedIn(document, source.path, jointPose);
    const changed = await changedText(source, this.text, owned);
    expect(applyHunks(this.text, changed), source.name).toBe(changed.text);
    if (changed.hunks.length === 0) return changed;
    const again = await rewritten(source, changed.text, owned);
    expect(again, source.name).toBe(savedFileOf(writeParts(source.name, owned)).text);
    return changed;
  }

  /** The lines of a part in the file, as a hunk that changes them. */
  hunk(target: SourceTarget): LineHunk {
    const [{ from, to }] = linesOf(mapSource(bytesOf(this.text), this.file.source.name), target);
    return { oldFrom: from, oldTo: to + 1, newFrom: from, newTo: to + 1 };
  }
}

/** Characters: longer captures have no other dialects. */
const LONG = 500_000;
const all = () => [...realFiles()].filter(([kind]) => kind !== 'rig');
const filesOf = (kind: string) => (realFiles().get(kind) ?? []).map(({ name, text }) => new Opened(name, text));
const lines = (text: string) => splitLines(text).lines;

describeShared('what the page changed in a real file', () => {
  it('is nothing after opening, for every file but the longest', async () => {
    for (const [, files] of all()) {
      for (const { name, text } of files) {
        if (text.length >= LONG) continue;
        const { hunks, text: same } = await new Opened(name, text).changed((character) => character);
        expect(hunks, name).toEqual([]);
        expect(same, name).toBe(text);
      }
    }
  });

  it('is the row of a moved key, and nothing once it is moved back or undone', async () => {
    const path = 'data/cse169/wasp_walk.anim';
    const opened = new Opened(path, textOf(path));
    const store = new Store(opened.document);
    const [{ id }] = store.document.characters;
    const channel = store.document.characters[0].takes[0].channels.findIndex(
      (c) => c.kind === 'keys' && c.times.length > 2,
    );
    const move = (value: number, seconds = 0) =>
      store.apply(moveKeys, { characterId: id, keys: [{ channel, indices: [1] }], seconds, values: [value] });
    move(0.5);
    const key = opened.hunk({ kind: 'key', channel, key: 1 });
    expect((await opened.changedIn(store.document)).hunks).toEqual([key]);
    move(0, 0.001);
    expect((await opened.changedIn(store.document)).hunks).toEqual([key]);
    store.undo();
    store.undo();
    expect((await opened.changedIn(store.document)).hunks).toEqual([]);
  });

  it('is the row of a moved key, and the count and row of an added one, where channels are numbered', async () => {
    const path = 'data/field/arm-numbered.anim';
    const opened = new Opened(path, textOf(path));
    const store = new Store(opened.document);
    const [{ id }] = store.document.characters;
    const target = { kind: 'key', channel: 4, key: 1 } as const;
    store.apply(moveKeys, { characterId: id, keys: [{ channel: 4, indices: [1] }], seconds: 0, values: [0.5] });
    expect((await opened.changedIn(store.document)).hunks).toEqual([opened.hunk(target)]);
    store.undo();
    store.apply(addKey, { characterId: id, channel: 4, timeSeconds: 0.123, value: 2 });
    const { text, hunks } = await opened.changedIn(store.document);
    expect(hunks.map((h) => [h.oldTo - h.oldFrom, h.newTo - h.newFrom])).toEqual([
      [1, 1],
      [0, 1],
    ]);
    expect(text.match(/channel \d+ \{/g)).toEqual(opened.text.match(/channel \d+ \{/g));
  });

  it('of a skeleton is the line of an offset, and only its changed numbers are written anew', async () => {
    for (const opened of filesOf('skel')) {
      const { text, hunks } = await opened.changed((character) => {
        const { skeleton } = character;
        if (!skeleton) return character;
        const joints = skeleton.joints.map((j, i) => {
          const [x, y, z] = j.offset;
          return i === skeleton.joints.length - 1 ? { ...j, offset: [x, y + 0.125, z] as const } : j;
        });
        return { ...character, skeleton: { ...skeleton, joints } };
      });
      expect(hunks, opened.file.source.name).toHaveLength(1);
      const [{ oldFrom, oldTo, newFrom, newTo }] = hunks;
      expect([oldTo - oldFrom, newTo - newFrom]).toEqual([1, 1]);
      const [before, after] = [lines(opened.text)[oldFrom - 1], lines(text)[newFrom - 1]];
      expect(after).toMatch(/^\s*offset/i);
      expect(after.split(/\s+/).filter((word, i) => word !== before.split(/\s+/)[i])).toHaveLength(1);
    }
  });

  it('of a skeleton is the block of a joint that was deleted or added, with what only the file says', async () => {
    for (const opened of filesOf('skel')) {
      const { name } = opened.file.source;
      const [character] = opened.document.characters;
      const joints = character.skeleton?.joints ?? [];
      const leaf = joints.length - 1;
      const block = opened.hunk({ kind: 'joint', root: 0, joint: leaf });
      const add = new Store(opened.document);
      add.apply(addJoint, { characterId: character.id, parent: leaf });
      const [added, ...others] = (await opened.changedIn(add.document)).hunks;
      expect([others.length, added.oldTo - added.oldFrom, added.newTo - added.newFrom], name).toEqual([0, 0, 3]);
      if (leaf === 0) continue;
      const remove = new Store(opened.document);
      remove.apply(removeJoint, { characterId: character.id, joint: leaf, children: 'too' });
      expect((await opened.changedIn(remove.document)).hunks, name).toEqual([{ ...block, newTo: block.newFrom }]);
    }
  });

  it('of a skin is the row of a vertex', async () => {
    for (const opened of filesOf('skin')) {
      const { hunks } = await opened.changed((character) => ({
        ...character,
        skins: character.skins.map((skin) => {
          const positions = skin.positions.slice();
          positions[4] += 1;
          return { ...skin, positions };
        }),
      }));
      const [{ from }] = linesOf(mapSource(bytesOf(opened.text), 'a.skin'), { kind: 'vertex', vertex: 1 });
      expect(hunks).toEqual([{ oldFrom: from, oldTo: from + 1, newFrom: from, newTo: from + 1 }]);
    }
  });

  it('of a capture is the row of a frame, in any dialect', async () => {
    for (const opened of filesOf('bvh').filter(({ text }) => text.length < LONG)) {
      const { hunks } = await opened.changed((character) => ({
        ...character,
        takes: character.takes.map((take) => {
          if (!take.samples) return take;
          const values = take.samples.values.slice();
          values[values.length - 1] += 0.25;
          return { ...take, samples: { ...take.samples, values } };
        }),
      }));
      const { name } = opened.file.source;
      expect(hunks.length, name).toBeLessThanOrEqual(opened.document.characters.length);
      for (const hunk of hunks) expect(hunk.newTo - hunk.newFrom, name).toBe(1);
    }
  });

  it('of an axis-angle skeleton is the row of a joint', async () => {
    for (const opened of filesOf('axskel')) {
      const { hunks } = await opened.changed((character) => {
        const pose = [...character.pose];
        pose[pose.length - 1] += 0.25;
        return { ...character, pose };
      });
      expect(hunks.map(({ oldFrom, oldTo, newFrom, newTo }) => [oldTo - oldFrom, newTo - newFrom])).toEqual(
        hunks.map(() => [1, 1]),
      );
    }
  });

  it('of poses is a renamed one', async () => {
    for (const opened of filesOf('pose')) {
      const { text, hunks } = await opened.changed((character) => ({
        ...character,
        ...(character.poses && { poses: character.poses.map((p, i) => (i === 0 ? { ...p, name: 'stand by' } : p)) }),
      }));
      expect(hunks).toHaveLength(1);
      expect(text).toContain('stand by');
    }
  });

  it('is told line by line also if it can’t be merged', async () => {
    const opened = new Opened('data/axis-skel/arm3.axskel', textOf('data/axis-skel/arm3.axskel'));
    const { hunks } = await opened.changed((character) => {
      const { skeleton } = character;
      const joints = skeleton?.joints.map((j) => ({ ...j, offset: [1, 2, 3] as const }));
      return skeleton && joints ? { ...character, skeleton: { ...skeleton, joints } } : character;
    });
    expect(hunks.length).toBeGreaterThan(0);
  });
});

describe('what the page changed in a file', () => {
  it('can’t be told of a text with errors', async () => {
    const text = 'balljoint a {\n\toffset 0 0 0\n}\n';
    const { document } = openFiles(EMPTY_DOCUMENT, [parsed('a.skel', text)]);
    const owned = ownedIn(document, 'a.skel', jointPose);
    const source = { name: 'a.skel', path: 'a.skel', bytes: 1 };
    await expect(changedText(source, text.replace('0 0 0', '0 0 x'), owned)).rejects.toThrow('a.skel has errors');
  });
});
