/** Writes `.attach.json`, a line for each attachment. */
import type { AttachFile } from '../../model/takes/attach-file.ts';
import { flattenedValue } from '../json/flattened.ts';
import { writeJson } from '../json/write.ts';
import type { WriteResult } from '../reader.ts';

/** `fileName` appears in diagnostics. */
export function writeAttach({ base, flattened, attached, others }: AttachFile, fileName = ''): WriteResult {
  const rows = attached.map(({ character, joint, span, offset, others: kept }) => ({
    ...{ character, joint, span },
    offset: { position: offset.position, rotation: offset.rotation, ...offset.others },
    ...kept,
  }));
  return writeJson({ base, flattened: flattenedValue(flattened), attached: rows, ...others }, fileName);
}
