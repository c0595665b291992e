/** Any content as a whole file. */

import { outputOf, savedFileOf } from '../../src/files/save/output.ts';
import type { WriteResult } from '../../src/formats/reader.ts';
import type { FileContent } from '../../src/model/files.ts';

/** In the format of its name, as the page and the command write it. Throws an `Error` if there is none. */
export function writeFile(content: FileContent, name: string): WriteResult {
  const { text, diagnostics } = savedFileOf(outputOf({ name, content: () => content }));
  return { text, diagnostics };
}
