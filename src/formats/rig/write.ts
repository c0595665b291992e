/** Writes `.rig`, laid out like the course's own file. */
import type { Rig } from '../../model/rig.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** Writes a `.rig`. @param fileName appears in diagnostics */
export function writeRig(rig: Rig, fileName = ''): WriteResult {
  const text = new Text(fileName);
  text.line(0, `rig${text.name(rig.name, 'rig')} {`);
  if (rig.skeleton !== undefined) text.line(1, `skeleton ${text.file(rig.skeleton, 'skeleton file')}`);
  if (rig.skin !== undefined) text.line(1, `skin ${text.file(rig.skin, 'skin file')}`);
  text.line(1, `morphs ${rig.morphs.length} {`);
  for (const morph of rig.morphs) text.line(2, text.file(morph, 'morph file'));
  text.line(1, '}');
  if (rig.animation !== undefined) text.line(1, `animation ${text.file(rig.animation, 'animation file')}`);
  text.line(0, '}');
  return text.result();
}
