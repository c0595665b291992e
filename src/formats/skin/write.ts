/** Writes `.skin`, its blocks in the order of the course's files; each material is followed by its triangles. */
import type { Attachments, Material, Skin } from '../../model/skin.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** Writes a `.skin`. @param fileName appears in diagnostics */
export function writeSkin(skin: Skin, fileName = ''): WriteResult {
  const text = new Text(fileName);
  const { positions, normals, texcoords, attachments, triangles, surfaces, bindings } = skin;
  text.rows('positions', 3, positions);
  if (normals) text.rows('normals', 3, normals);
  if (texcoords) text.rows('texcoords', 2, texcoords);
  if (attachments) writeAttachments(text, attachments);
  surfaces.forEach(({ material, triangleStart, triangleCount }, i) => {
    // Without a block of its own it would have the material before it.
    if (material || i > 0) writeMaterial(text, material ?? { name: '' });
    text.rows('triangles', 3, triangles.subarray(3 * triangleStart, 3 * (triangleStart + triangleCount)));
  });
  const joints = Math.floor(bindings.length / 16);
  text.line(0, `bindings ${joints} {`);
  for (let joint = 0; joint < joints; joint++) {
    text.about(`the binding of joint ${joint}`);
    text.line(1, 'matrix {');
    for (let column = 0; column < 4; column++) {
      const at = 16 * joint + 4 * column;
      text.line(2, text.numbers([bindings[at], bindings[at + 1], bindings[at + 2]]));
    }
    text.line(1, '}');
  }
  text.line(0, '}');
  return text.result();
}

function writeMaterial(text: Text, { name, texture, color }: Material): void {
  text.line(0, `material${text.name(name, 'material')} {`);
  if (texture !== undefined) text.line(1, `texture ${text.file(texture, 'texture')}`);
  text.about(`material "${name}"`);
  if (color) text.line(1, `color ${text.numbers(color)}`);
  text.line(0, '}');
}

function writeAttachments(text: Text, { start, joints, weights }: Attachments): void {
  const rows = start.length - 1;
  text.line(0, `skinweights ${rows} {`);
  text.about('skinweights');
  for (let row = 0; row < rows; row++) {
    text.row = row + 1;
    let line = `${start[row + 1] - start[row]}`;
    for (let i = start[row]; i < start[row + 1]; i++) line += ` ${joints[i]} ${text.number(weights[i])}`;
    text.line(1, line);
  }
  text.line(0, '}');
}
