/**
 * The writer of each kind of text file. Separate from the readers: the page writes files but reads them in its worker.
 */
import { writeAnim } from '../../formats/anim/write.ts';
import { writeBvh } from '../../formats/bvh/write.ts';
import { writeMorph } from '../../formats/morph/write.ts';
import { writePoses } from '../../formats/pose/write.ts';
import type { WriteResult } from '../../formats/reader.ts';
import { writeRig } from '../../formats/rig/write.ts';
import { writeSkel } from '../../formats/skel/write.ts';
import { writeSkin } from '../../formats/skin/write.ts';
import type { FileContent } from '../../model/files.ts';
import { FORMAT_KINDS, type FormatKind, formatKindOf, KINDS } from '../kinds.ts';

type ContentOf<K extends FormatKind> = Extract<FileContent, { readonly kind: (typeof KINDS)[K]['content'] }>;
type Writers = { readonly [K in FormatKind]: (content: ContentOf<K>, fileName: string) => WriteResult };

const skel: Writers['skel'] = ({ skeletons }, name) => writeSkel(skeletons, name);

const WRITERS: Writers = {
  skel,
  axskel: skel,
  skin: ({ skin }, name) => writeSkin(skin, name),
  morph: ({ morph }, name) => writeMorph(morph, name),
  anim: ({ clip }, name) => writeAnim(clip, name),
  rig: ({ rig }, name) => writeRig(rig, name),
  bvh: ({ figures }, name) => writeBvh(figures, name),
  pose: ({ poses }, name) => writePoses(poses, name),
};

/**
 * Writes a model as text, in the format of the file name or else the first one for such content. Undefined for images,
 * which are not text. `fileName` appears in diagnostics.
 */
export function writeFile(content: FileContent, fileName: string): WriteResult | undefined {
  const holds = (kind: FormatKind) => KINDS[kind].content === content.kind;
  const named = formatKindOf(fileName);
  const kind = named && holds(named) ? named : FORMAT_KINDS.find(holds);
  // The kind was chosen for this content; TypeScript can't infer that from the union.
  return kind && (WRITERS[kind] as (content: FileContent, fileName: string) => WriteResult)(content, fileName);
}
