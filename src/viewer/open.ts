/** Reads files and makes characters of them, in the worker of the elements, or in their page where that has none. */
import { provideLayers } from '../evaluate/layers.ts';
import { openFiles } from '../files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../model/document.ts';
import { parse } from '../worker/parse.ts';
import type { OpenInput, OpenOutput } from '../worker/protocol.ts';
import { openedOf } from './opened.ts';

/** The characters of files. Whatever is wrong with them is a diagnostic. */
export async function openCharacters({ files }: OpenInput): Promise<OpenOutput> {
  provideLayers();
  const { files: read, broken, diagnostics } = await parse({ files }, () => undefined);
  const { document, diagnostics: more } = openFiles(EMPTY_DOCUMENT, read, broken);
  return openedOf(document, [...diagnostics, ...more]);
}
