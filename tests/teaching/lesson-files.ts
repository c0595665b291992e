/** Characters to make wrong numbers of: our examples, and the reference files where they are. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { openFiles } from '../../src/files/open/open-files.ts';
import type { Character } from '../../src/model/document.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { ParsedFile } from '../../src/model/files.ts';
import { parsed } from '../helpers/parsed.ts';
import { sharedPath } from '../helpers/shared.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));

/** The bytes of one of our examples. */
export function ownBytes(name: string): Uint8Array {
  return new Uint8Array(readFileSync(SAMPLES + name));
}

/** The first character of files: paths in `../shared/`, or names of our examples. */
export function characterOf(...paths: readonly string[]): Character {
  const files = paths.map((path): ParsedFile => {
    const name = path.slice(path.lastIndexOf('/') + 1);
    return parsed(name, path.includes('/') ? new Uint8Array(readFileSync(sharedPath(path))) : ownBytes(path));
  });
  return openFiles(EMPTY_DOCUMENT, files).document.characters[0];
}

/** The character of one file. */
export function characterFrom(name: string, text: string): Character {
  return characterOfTexts({ [name]: text });
}

/** The character of files by their names. */
export function characterOfTexts(texts: Readonly<Record<string, string>>): Character {
  const files = Object.entries(texts).map(([name, text]) => parsed(name, new TextEncoder().encode(text)));
  return openFiles(EMPTY_DOCUMENT, files).document.characters[0];
}

/** Ours. */
export const OWN = {
  walker: ['walker.skel', 'walker.skin', 'walker_breathe.morph', 'walker_smile.morph', 'walker_walk.anim'],
  crawler: ['crawler.skel', 'crawler.skin', 'crawler_walk.anim'],
  joints: ['joints.skel', 'joints.skin', 'joints_each.anim'],
  tangents: ['tangents.skel', 'tangents.skin', 'tangents.anim'],
} as const;

/** Of the reference. */
const COMPARE = 'conformance/compare/';
export const SHARED = {
  wasp: ['data/cse169/wasp.skel', 'data/cse169/wasp.skin', 'data/cse169/wasp_walk.anim'],
  tube: ['data/cse169/tube.skel', 'data/cse169/tube.skin'],
  test: ['data/cse169/test.skel', 'data/synthetic/limits.anim'],
  dragon: ['data/cse169/dragon.skel'],
  head: ['data/cse169/head.skel', 'data/cse169/head.skin', 'data/cse169/head1.morph', 'data/cse169/head2.morph'],
  six: ['data/synthetic/six.skel', 'data/synthetic/six.skin'],
  nine: ['data/synthetic/nine.skel', 'data/synthetic/nine.skin'],
  human: ['data/axis-skel/human.axskel'],
  hexapod: ['data/axis-skel/hexapod.axskel'],
  poser: ['data/bvh/poser-sl-walk.bvh'],
  lafan: ['data/bvh/lafan1-dance-10frames.bvh'],
  makehuman: ['data/bvh/makehuman-tpose-add.bvh'],
  curves: [`${COMPARE}curves.anim`],
  sample: ['data/cse169/sample.anim'],
  kinds: [`${COMPARE}kinds.skel`],
  reed: [
    `${COMPARE}reed.skel`,
    `${COMPARE}reed.skin`,
    `${COMPARE}reed_1.morph`,
    `${COMPARE}reed_2.morph`,
    `${COMPARE}reed_move.anim`,
  ],
} as const;
