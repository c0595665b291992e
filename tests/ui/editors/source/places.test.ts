import { describe, expect, it } from 'vitest';
import { openFiles } from '../../../../src/files/open/open-files.ts';
import { mapSource } from '../../../../src/formats/source/map-source.ts';
import type { Document } from '../../../../src/model/document.ts';
import { EMPTY_DOCUMENT } from '../../../../src/model/document.ts';
import { NOTHING_SELECTED, type Selection } from '../../../../src/model/session.ts';
import { linesOf, targetAt } from '../../../../src/model/source-map.ts';
import { frameAt, partsFrom, pickOf, sourcesOf, targetsOf } from '../../../../src/ui/editors/source/places.ts';
import { bytesOf, read } from '../../../formats/read-in-pieces.ts';

const SKEL = 'balljoint hips {\noffset 0 1 0\nrotxlimit -1 1\nballjoint leg {\noffset 0 -1 0\n}\n}';
const SKIN = [
  ...['positions 3 {', '0 0 0', '1 0 0', '0 1 0', '}', 'skinweights 3 {', '1 0 1', '1 1 1', '1 1 1', '}'],
  ...['triangles 1 {', '0 1 2', '}', 'bindings 2 {', 'matrix {', '1 0 0', '0 1 0', '0 0 1', '0 0 0', '}'],
  ...['matrix {', '1 0 0', '0 1 0', '0 0 1', '0 0 0', '}', '}'],
].join('\n');
const channel = 'channel {\nextrapolate constant constant\nkeys 2 {\n0 0 flat flat\n1 1 flat flat\n}\n}\n';
const ANIM = `animation {\nrange 0 1\nnumchannels 9\n${channel.repeat(9)}}`;
const BVH =
  'HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 3\nFrame Time: 0.5\n1\n2\n3\n';
const TEXTS: Readonly<Record<string, string>> = { 'a.skel': SKEL, 'a.skin': SKIN, 'a.anim': ANIM, 'b.bvh': BVH };

function opened(): Document {
  const files = Object.entries(TEXTS).map(([name, text]) => {
    const { value } = read(name, text);
    if (!value) throw new Error(`${name} has errors`);
    return { ...value, source: { name, path: `my/${name}`, bytes: text.length } };
  });
  const { document } = openFiles(EMPTY_DOCUMENT, files, [], undefined);
  return document;
}

const document = opened();
const [character, capture] = ['a', 'b'].map((name) => document.characters.find((c) => c.name === name));
const id = character?.id ?? '';

/** The lines in a file of what is selected. */
function lit(name: string, selection: Selection, dof?: number) {
  const map = mapSource(bytesOf(TEXTS[name]), name);
  const chosen = dof === undefined ? undefined : { characterId: id, dof };
  return partsFrom(document, `my/${name}`)
    .flatMap((parts) => targetsOf(parts, selection, chosen))
    .flatMap((target) => linesOf(map, target))
    .map(({ from, to }) => [from, to]);
}

function picked(name: string, line: number) {
  const target = targetAt(mapSource(bytesOf(TEXTS[name]), name), line);
  return target && pickOf(partsFrom(document, `my/${name}`), target);
}

describe('what is selected, in the text of its files', () => {
  it('a joint has its lines, its binding and its channels', () => {
    const selection = { characterId: id, joint: 1 };
    expect(lit('a.skel', selection)).toEqual([[4, 6]]);
    expect(lit('a.skin', selection)).toEqual([[21, 26]]);
    expect(lit('a.anim', selection)).toEqual([
      [46, 52],
      [53, 59],
      [60, 66],
    ]);
  });

  it('a DOF that was chosen has its limits and its channel', () => {
    const selection = { characterId: id, joint: 0 };
    expect(lit('a.skel', selection, 3)).toEqual([[3, 3]]);
    expect(lit('a.anim', selection, 3)).toEqual([[25, 31]]);
  });

  it('a vertex has its position, its weights and its triangles; a key its row', () => {
    expect(lit('a.skin', { characterId: id, vertex: 1 })).toEqual([
      [3, 3],
      [8, 8],
      [12, 12],
    ]);
    const keys = [{ channel: 1, indices: [1] }];
    expect(lit('a.anim', { characterId: id, joint: 0, keys })).toEqual([[15, 15]]);
  });

  it('nothing and another character have no lines', () => {
    expect(lit('a.skel', NOTHING_SELECTED)).toEqual([]);
    expect(lit('a.skel', { characterId: capture?.id ?? '', joint: 0 })).toEqual([]);
  });

  it('the frame of a time is that of the capture', () => {
    const [parts] = partsFrom(document, 'my/b.bvh');
    expect(frameAt(parts, 0.6)).toEqual({ kind: 'frame', frame: 1 });
    expect(frameAt(parts, 7)).toBeUndefined();
  });

  it('the files of the selected character come first', () => {
    const names = (characterId: string | undefined) => sourcesOf(document, characterId).map(({ name }) => name);
    expect(names(capture?.id)[0]).toBe('b.bvh');
    expect(names(id)[0]).not.toBe('b.bvh');
    expect(names(id)).toHaveLength(4);
  });
});

describe('what a click on a line selects', () => {
  it('a joint, or one of its DOFs', () => {
    expect(picked('a.skel', 5)?.selection).toEqual({ characterId: id, joint: 1 });
    expect(picked('a.skel', 3)).toMatchObject({
      selection: { characterId: id, joint: 0 },
      dof: { dof: 3, name: 'rx' },
    });
    expect(picked('a.skin', 16)?.selection).toEqual({ characterId: id, joint: 0 });
  });

  it('a vertex, and of a triangle its first one, naming all three', () => {
    expect(picked('a.skin', 3)?.selection).toEqual({ characterId: id, vertex: 1 });
    expect(picked('a.skin', 8)?.selection).toEqual({ characterId: id, vertex: 1 });
    expect(picked('a.skin', 12)).toEqual({
      selection: { characterId: id, vertex: 0 },
      text: 'Triangle 0: vertices 0 1 2, 0 selected',
    });
    expect(picked('a.skin', 1)).toBeUndefined();
  });

  it('a key with its joint, at its time; a frame, at its time', () => {
    expect(picked('a.anim', 29)).toMatchObject({
      selection: { characterId: id, joint: 0, keys: [{ channel: 3, indices: [1] }] },
      dof: { dof: 3 },
      timeSeconds: 1,
    });
    expect(picked('b.bvh', 12)).toMatchObject({ selection: { characterId: capture?.id }, timeSeconds: 1 });
  });

  it('what is selected by a click on a line lights up that line', () => {
    for (const name of Object.keys(TEXTS)) {
      const lines = TEXTS[name].split('\n').length;
      for (let line = 1; line <= lines; line++) {
        const found = picked(name, line);
        if (!found || found.text.startsWith('Frame')) continue;
        const ranges = lit(name, found.selection, found.dof?.dof);
        expect(
          ranges.some(([from, to]) => from <= line && line <= to),
          `${name}:${line} ${found.text}`,
        ).toBe(true);
      }
    }
  });
});
