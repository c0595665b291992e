import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { decode, emptyNumbers, RestoreError, storedNumbers } from '../../../src/app/autosave/decode.ts';
import { LARGE_BYTES } from '../../../src/app/autosave/encode.ts';
import type { Encoded, StorableNumbers } from '../../../src/app/autosave/encoded.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { fill, piecesOf, StoredPieces } from '../../../src/app/autosave/pieces.ts';
import type { Document } from '../../../src/model/document.ts';
import type { ParsedFile } from '../../../src/model/files.ts';
import { keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { trackedOf } from '../../../src/model/takes/tracked-take.ts';
import {
  animFile,
  character,
  documentOf,
  file,
  skeleton,
  skelFile,
  skin,
  skinFile,
  takeOfValues,
  trackedTake,
} from '../../helpers/builders.ts';
import { encodeAll } from './encode-all.ts';

const blob = (path: string) => ({ path, blob: new Blob([path]) });

/** Encodes and decodes; `files` are read again, so they are other objects. */
function thereAndBack(session: object, origins = new Origins(), files: readonly ParsedFile[] = []): unknown {
  const encoded = encodeAll(session, origins);
  const { puts } = new StoredPieces().plan(encoded.needs.arrays);
  const stored = structuredClone({
    tree: encoded.tree,
    pieces: new Map(puts.map((put) => [put.id, put.bytes()])),
    // Each a record of its own.
    chunks: encoded.chunks.map(({ id, of }) => ({ id, of: structuredClone(of) })),
    files: encoded.files.map((f) => f.path),
  });
  // Written by the encoder.
  const chunks = new Map(stored.chunks.map(({ id, of }) => [id, of as readonly Encoded[]]));
  const places = storedNumbers([stored.tree, ...[...chunks.values()].flat()]);
  const arrays = new Map(places.map((place) => [place, emptyNumbers(place)]));
  for (const [place, array] of arrays) {
    for (const piece of piecesOf(place)) fill(array, place, piece, stored.pieces.get(piece) ?? new Uint8Array());
  }
  const again = stored.files.map((path) => {
    const found = files.find((f) => f.source.path === path);
    if (!found) throw new Error(path);
    return found;
  });
  return decode(stored.tree, { files: again, arrays, chunks });
}

describe('encoding a session', () => {
  it('encoding a session gives back any plain data', () => {
    const numbers = fc.oneof(
      { weight: 6, arbitrary: fc.array(fc.double()).map((values) => Float64Array.from(values)) },
      { weight: 6, arbitrary: fc.array(fc.nat(255)).map((values) => Uint8Array.from(values)) },
      { weight: 6, arbitrary: fc.array(fc.nat()).map((values) => Uint32Array.from(values)) },
      // Several pieces long; rare, since comparing them takes most of the time.
      { weight: 1, arbitrary: fc.nat(200_000).map((length) => Float64Array.from({ length }, (_, i) => i / 3)) },
    );
    const { tree } = fc.letrec((tie) => ({
      tree: fc.oneof(
        { maxDepth: 4 },
        fc.constantFrom(undefined, null, true, -0, Number.NaN, Number.NEGATIVE_INFINITY, ''),
        fc.double(),
        fc.string(),
        numbers,
        fc.array(tie('tree')),
        fc.dictionary(
          fc.string().filter((key) => key !== '__proto__'),
          tie('tree'),
          { noNullPrototype: true },
        ),
      ),
    }));
    fc.assert(
      fc.property(tree, (value) => {
        expect(thereAndBack([value])).toStrictEqual([value]);
      }),
      { numRuns: 60 },
    );
  });

  it('preserves sharing of large and small arrays', () => {
    const large = new Float64Array(100_000);
    const small = Float64Array.of(1, 2);
    const inner = { large };
    // biome-ignore lint/suspicious/noExplicitAny: the decoded value is inspected
    const back = thereAndBack({ a: inner, b: inner, c: [large], d: small, e: { small } }) as any;
    expect(back.a).toBe(back.b);
    expect(back.c[0]).toBe(back.a.large);
    expect(back.d).toBe(back.e.small);
  });

  it('stores a small array that looks into a large buffer without the buffer', () => {
    const window = new Float64Array(100_000).subarray(10, 12);
    const { tree } = encodeAll(window, new Origins());
    expect((tree as Float64Array).buffer.byteLength).toBe(16);
  });

  it('stores a few words for content of files of any size', () => {
    const big = skin('hero', 0, { positions: new Float64Array(3_000_000) });
    const files = [skelFile('hero.skel', skeleton(3)), skinFile('hero.skin', big)];
    const origins = new Origins();
    origins.learn([blob('hero.skel'), blob('hero.skin')], files);
    const [skel] = files;
    const hero = character({ skeleton: skel.kind === 'skel' ? skel.skeletons[0] : skeleton(), skins: [big] });
    const encoded = encodeAll(documentOf(hero), origins);
    expect(encoded.needs.arrays.size).toBe(0);
    expect(JSON.stringify(encoded.tree).length).toBeLessThan(2000);
    expect(encoded.files.map((f) => f.path)).toEqual(['hero.skel', 'hero.skin']);
  });

  it('finds parts of files again, unedited ones as the objects read', () => {
    const read = () => [
      skelFile('d/hero.skel', skeleton(3)),
      animFile('d/walk.anim', takeOfValues('walk', [1, 2, 3, 4])),
    ];
    const files = read();
    const origins = new Origins();
    origins.learn([blob('d/hero.skel'), blob('d/walk.anim')], files);
    const [skel, anim] = files;
    if (skel.kind !== 'skel' || anim.kind !== 'anim') throw new Error('fixtures');
    const walk = anim.take;
    const channels = walk.channels.map((c, i) => (i === 2 ? { ...c, values: Float64Array.of(9) } : c));
    const session = documentOf(
      character({ skeleton: skel.skeletons[0], takes: [{ ...walk, channels }], shownTake: 0, sources: [skel.source] }),
    );
    const again = read();
    const back = thereAndBack(session, origins, again) as typeof session;
    expect(back).toEqual(session);
    const [newSkel, newAnim] = again;
    if (newSkel.kind !== 'skel' || newAnim.kind !== 'anim') throw new Error('fixtures');
    expect(back.characters[0].skeleton).toBe(newSkel.skeletons[0]);
    expect(back.characters[0].sources[0]).toBe(newSkel.source);
    expect(back.characters[0].takes[0].channels[1]).toBe(newAnim.take.channels[1]);
    expect(keysOf(back.characters[0].takes[0].channels[2]).times).toBe(keysOf(newAnim.take.channels[2]).times);
    expect([...keysOf(back.characters[0].takes[0].channels[2]).values]).toEqual([9]);
  });

  it('makes no channels of a take of a file, and finds those that were made since', () => {
    let made = 0;
    const read = () => {
      const takes = ['walk', 'run'].map((name) => trackedTake(name, () => made++));
      return file('hero.glb', {
        kind: 'character',
        characters: [{ skeleton: skeleton(2), skins: [], morphs: [], takes, textures: [] }],
      });
    };
    const opened = read();
    const origins = new Origins();
    origins.learn([blob('hero.glb')], [opened]);
    if (opened.kind !== 'character') throw new Error('fixtures');
    const [{ takes }] = opened.characters;
    const whole = thereAndBack(documentOf(character({ takes })), origins, [read()]) as Document;
    expect(made).toBe(0);
    expect(whole.characters[0].takes.map((take) => trackedOf(take)?.name)).toEqual(['walk', 'run']);
    const channels = takes[1].channels.map((c, i) => (i === 2 ? restChannel(9) : c));
    const edited = documentOf(character({ takes: [takes[0], { ...takes[1], channels }] }));
    const again = read();
    if (again.kind !== 'character') throw new Error('fixtures');
    const back = thereAndBack(edited, origins, [again]) as Document;
    expect(back.characters[0].takes[1].channels[1]).toBe(again.characters[0].takes[1].channels[1]);
    expect(back).toEqual(edited);
  });

  it('refuses if a file reads differently than before', () => {
    const files = [skelFile('hero.skel', skeleton(3))];
    const origins = new Origins();
    origins.learn([blob('hero.skel')], files);
    const [skel] = files;
    if (skel.kind !== 'skel') throw new Error('fixtures');
    const session = { joint: skel.skeletons[0].joints[2] };
    expect(() => thereAndBack(session, origins, [skelFile('hero.skel', skeleton(2))])).toThrow(RestoreError);
  });

  it('knows which of several files opened together a part is of, those in a zip too', () => {
    const origins = new Origins();
    const a = skelFile('heroes.zip/a.skel', skeleton(1));
    const b = skelFile('b.skel', skeleton(1));
    origins.learn([blob('heroes.zip'), blob('b.skel')], [a, b]);
    expect(origins.find(a)?.file.given.given.path).toBe('heroes.zip');
    expect(origins.find(b)?.file.given.given.path).toBe('b.skel');
  });

  it('attributes nothing to a file if two were opened under one name', () => {
    const origins = new Origins();
    const a = skelFile('a.skel', skeleton(1));
    origins.learn([blob('a.skel'), blob('a.skel')], [a]);
    expect(origins.find(a)).toBeUndefined();
  });

  it('stores a texture as its file', () => {
    const bytes = new Uint8Array(100_000) as StorableNumbers & Uint8Array<ArrayBuffer>;
    const picture = file('hero.png', { kind: 'texture', texture: { name: 'hero.png', mime: 'image/png', bytes } });
    const origins = new Origins();
    origins.learn([blob('hero.png')], [picture]);
    expect(bytes.byteLength).toBeGreaterThan(LARGE_BYTES);
    expect(encodeAll({ bytes }, origins).needs.arrays.size).toBe(0);
  });
});
