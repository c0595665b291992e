/** Details of one vertex of a skin: its position in the file and now, and its attachments. */
import { vertexDeformer } from '../../../evaluate/skin/one-vertex.ts';
import type { Character } from '../../../model/document.ts';
import { type Material, type Skin, vertexCount } from '../../../model/skin.ts';
import type { Uses } from '../../state/workbench.ts';
import { count, errorSize, shown } from '../../widgets/numbers/number-text.ts';
import { FactList, type FactView } from './fact-list.ts';

const AXES = ['x', 'y', 'z'];

export function vertexFacts(wb: Uses<'viewport'>, character: Character, skin: Skin, vertex: number): FactView {
  const { id, skeleton, morphs } = character;
  const list = new FactList(`Vertex ${vertex}`);
  list.fact('Index', `${count(vertex)} of ${count(vertexCount(skin))} in ${skin.name}`);
  const rowLabels = ['in file', 'now'];
  const position = list.grid({ label: 'Position', rows: 2, columns: 3, rowLabels, columnLabels: AXES }).grid;
  position.setRow(0, skin.positions, 3 * vertex);
  const { normals } = skin;
  const normal = normals && list.grid({ label: 'Normal', rows: 2, columns: 3, rowLabels, columnLabels: AXES }).grid;
  if (normals) normal?.setRow(0, normals, 3 * vertex);
  else list.fact('Normal', 'not in the file, computed from the triangles');
  if (skin.texcoords) {
    const texture = list.grid({ label: 'Texture', rows: 1, columns: 2, columnLabels: ['u', 'v'] });
    texture.grid.setRow(0, skin.texcoords, 2 * vertex);
  }
  for (const material of materialsAt(skin, vertex)) list.fact('Material', materialText(material));
  addAttachments(list, character, skin, vertex);
  const deform = vertexDeformer(skin, morphs, vertex);
  const fill = () => {
    const facts = wb.viewport.character(id);
    if (!facts) return;
    const now = deform(facts.dofs, skeleton ? facts.worldMatrices() : undefined);
    position.setRow(1, now.position);
    if (now.normal) normal?.setRow(1, now.normal);
  };
  return { element: list.element, fill };
}

/** Of the triangles around it. */
export function materialsAt({ surfaces, triangles }: Skin, vertex: number): readonly Material[] {
  const around = surfaces.filter(({ triangleStart, triangleCount }) =>
    triangles.subarray(3 * triangleStart, 3 * (triangleStart + triangleCount)).includes(vertex),
  );
  return [...new Set(around.flatMap(({ material }) => material ?? []))];
}

/** `cloth: cloth.png × 1 0.5 0` */
export function materialText({ name, texture, color }: Material): string {
  const looks = [texture, color?.map((part) => shown(part)).join(' ')].filter((look) => look !== undefined);
  return [name, looks.join(' × ')].filter((part) => part !== '').join(': ') || 'without a name';
}

function addAttachments(list: FactList, character: Character, skin: Skin, vertex: number): void {
  const { attachments } = skin;
  if (!attachments) return void list.fact('Attachments', 'none in the file; it follows the root');
  const from = attachments.start[vertex];
  const size = attachments.start[vertex + 1] - from;
  if (size === 0) return void list.fact('Attachments', 'none; it stays in place');
  const weights = attachments.weights.subarray(from, from + size);
  const joints = [...attachments.joints.subarray(from, from + size)];
  const { grid, note } = list.grid({
    label: 'Attachments',
    rows: size,
    columns: 1,
    rowLabels: joints.map((j) => `${character.skeleton?.joints[j]?.name || 'joint'} ${j}`),
    columnLabels: ['weight'],
  });
  weights.forEach((weight, i) => {
    grid.set(i, 0, weight);
  });
  const sum = weights.reduce((total, weight) => total + weight, 0);
  note(Math.abs(sum - 1) > 1e-9 ? `sum off by ${errorSize(Math.abs(sum - 1))}` : 'sum 1');
}
