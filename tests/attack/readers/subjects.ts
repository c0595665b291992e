/** What is read from bytes or texts, by the extension that the file of a reproducer has. */
export const SUBJECTS = [
  'skel',
  'axskel',
  'skin',
  'morph',
  'anim',
  'rig',
  'bvh',
  'asf',
  'amc',
  'npy',
  'npz',
  'c3d',
  'trc',
  'pose',
  'markers.json',
  'sets.json',
  'layers.json',
  'limbs.json',
  'attach.json',
  'txt',
  'csv',
  'json',
  'obj',
  'ply',
  'bmp',
  'png',
  'jpg',
  'webp',
  'gltf',
  'glb',
  'vrm',
  'vrma',
  'fbx',
  'zip',
  'review.csv',
  'review.json',
  'manifest.ndjson',
  'settings.json',
] as const;

export type Subject = (typeof SUBJECTS)[number];

export function isSubject(text: string): text is Subject {
  return SUBJECTS.some((subject) => subject === text);
}
