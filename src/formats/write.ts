/**
 * A model as the text of a file. Apart from the registry: the page writes files but reads them in its worker, and need
 * not carry the readers too.
 */
import type { FileContent } from '../model/files.ts';
import { writeAnim } from './anim/write.ts';
import { writeBvh } from './bvh/write.ts';
import { writeMorph } from './morph/write.ts';
import { writePoses } from './pose/write.ts';
import type { WriteResult } from './reader.ts';
import { writeRig } from './rig/write.ts';
import { writeSkel } from './skel/write.ts';
import { writeSkin } from './skin/write.ts';

/** Undefined for what is no text: pictures. `fileName` is what infos name. */
export function writeFile(content: FileContent, fileName: string): WriteResult | undefined {
  switch (content.kind) {
    case 'skel':
      return writeSkel(content.skeletons, fileName);
    case 'skin':
      return writeSkin(content.skin, fileName);
    case 'morph':
      return writeMorph(content.morph, fileName);
    case 'anim':
      return writeAnim(content.clip, fileName);
    case 'rig':
      return writeRig(content.rig, fileName);
    case 'bvh':
      return writeBvh(content.figures, fileName);
    case 'pose':
      return writePoses(content.poses, fileName);
    case 'texture':
      return undefined;
  }
}
