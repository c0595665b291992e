/**
 * `open-in-steps.ts` at once, with all that any file may need: the page, which opens in steps, fetches what reads JSON
 * beside other files only with the first of it.
 */

import { runToEnd } from '../../evaluate/steps.ts';
import type { Document } from '../../model/document.ts';
import { type BrokenFile, byFileName, type ParsedFile } from '../../model/files.ts';
import { openBeside } from './beside-files.ts';
import { lostOver } from './lost-over.ts';
import { type OpenResult, openInSteps } from './open-in-steps.ts';

/**
 * Opens files that were read: as new characters, or as parts of existing ones.
 * @param files in the order that decides between alternatives: as given on a command line, by name for a drop
 * @param broken files given with them that have errors
 * @param selectedId the character that receives a single skin, morph or anim
 * @param called how messages name files
 */
export function openFiles(
  document: Document,
  files: readonly ParsedFile[],
  broken: readonly BrokenFile[] = [],
  selectedId?: string,
  called = byFileName,
): OpenResult {
  const result = runToEnd(openInSteps(document, files, broken, selectedId, called, openBeside));
  return { ...result, diagnostics: [...result.diagnostics, ...lostOver(document, result.document, called)] };
}
