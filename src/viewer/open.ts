/** Reads files and makes characters of them, in the worker of the elements, or in their page where that has none. */
import { runToEnd } from '../evaluate/steps.ts';
import { openInSteps } from '../files/open/open-in-steps.ts';
import { EMPTY_DOCUMENT } from '../model/document.ts';
import { byFileName } from '../model/files.ts';
import { parse } from '../worker/parse.ts';
import type { OpenInput, OpenOutput } from '../worker/protocol.ts';
import { openedOf } from './opened.ts';

/** The characters of files. Whatever is wrong with them is a diagnostic. */
export async function openCharacters({ files }: OpenInput): Promise<OpenOutput> {
  // Few files have JSON beside them, with layers, limbs or attachments; what reads it brings all that moves these.
  const hasBeside = files.some(({ path }) => /\.(json|zip)$/i.test(path));
  const beside = hasBeside ? await import('../files/open/beside-files.ts') : undefined;
  const { files: read, broken, diagnostics } = await parse({ files }, () => undefined);
  const steps = openInSteps(EMPTY_DOCUMENT, read, broken, undefined, byFileName, beside?.openBeside);
  const { document, diagnostics: more } = runToEnd(steps);
  return openedOf(document, [...diagnostics, ...more]);
}
