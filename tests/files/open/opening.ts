/** What tests of opening share. */
import { expect } from 'vitest';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Character, type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { BrokenFile, ParsedFile } from '../../../src/model/files.ts';
import { file, takeOfValues } from '../../helpers/builders.ts';

export const open = (files: ParsedFile[], document: Document = EMPTY_DOCUMENT, selected?: string) =>
  openFiles(document, files, [], selected);

/** The only character of a document. */
export const only = (document: Document): Character => {
  expect(document.characters).toHaveLength(1);
  return document.characters[0];
};

/** A file with errors. */
export const broken = (path: string, kind: BrokenFile['kind']): BrokenFile => ({
  kind,
  source: { path, name: path.slice(path.lastIndexOf('/') + 1), bytes: 1 },
});

export const texture = (path: string) =>
  file(path, { kind: 'texture', texture: { name: path, mime: 'image/png', bytes: new Uint8Array(1) } });

/** A take of a skeleton of two joints. */
export const walk = takeOfValues('hero_walk', [0, 1, 0, 0, 0, 0, 0, 0, 0]);
