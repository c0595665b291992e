/** Writes `.layers.json`, a line for each layer; what is as when left out is left out. */
import type { LayersFile } from '../../model/takes/layers-file.ts';
import { curveValue } from '../json/curve.ts';
import { flattenedValue } from '../json/flattened.ts';
import { writeJson } from '../json/write.ts';
import type { WriteResult } from '../reader.ts';

/** `fileName` appears in diagnostics. */
export function writeLayers({ base, flattened, layers, others }: LayersFile, fileName = ''): WriteResult {
  const rows = layers.map(({ name, file, mode, weight, mute, solo, joints, root, morphs, ofWeight, others: kept }) => ({
    ...{ name, file, mode },
    ...(weight !== 1 && { weight: curveValue({ curve: weight, ...(ofWeight && { others: ofWeight }) }) }),
    ...(mute && { mute }),
    ...(solo && { solo }),
    ...(joints && { joints }),
    ...(root && { root }),
    ...(morphs && { morphs }),
    ...kept,
  }));
  return writeJson({ base, flattened: flattenedValue(flattened), layers: rows, ...others }, fileName);
}
