/**
 * *Other programs*: which program opens what is saved here and which files of others are opened, as far as it was
 * tried. docs/guide/other-programs.md has the same rows; a test compares them.
 */
import type { DialogContent } from '../../widgets/dialog.ts';
import { element } from '../../widgets/dom.ts';

/** What was tried, or wasn't. */
export interface TriedProgram {
  readonly file: string;
  readonly program: string;
  readonly seen: string;
}

export const SAVED_FOR: readonly TriedProgram[] = [
  { file: '.glb', program: 'Blender 4.5.15 (bpy)', seen: 'joints and vertices within the tolerance, with linear keys' },
  {
    file: '.glb',
    program: 'Blender, bindings that scale or shear',
    seen: 'vertices are wrong: its bones ignore that',
  },
  { file: '.glb', program: 'three.js 0.187', seen: 'the same, with linear and cubic keys' },
  { file: '.glb', program: 'Babylon.js 9.35', seen: 'the same, with linear and cubic keys' },
  { file: '.glb', program: 'Khronos validator 2.0.0-dev.3.10', seen: 'no error, no warning' },
  { file: '.glb', program: 'Unity, Unreal, Godot, Maya, VRChat', seen: 'not tested' },
  { file: '.fbx', program: 'ufbx 0.21', seen: 'joints, vertices, takes and curves within the tolerance at any time' },
  {
    file: '.fbx',
    program: 'Blender 4.5.15 (bpy)',
    seen: 'the same at the frames of captures and of one key per frame; curves are straight between keys',
  },
  {
    file: '.fbx',
    program: 'three.js 0.187',
    seen: 'the same at the frames of captures; curves are straight between keys, four attachments',
  },
  { file: '.fbx', program: 'Maya, MotionBuilder, Unity, Unreal', seen: 'not tested' },
  { file: '.vrma', program: 'Khronos validator 2.0.0-dev.3.10', seen: 'no error, no warning' },
  { file: '.vrma', program: 'VRM players', seen: 'not tested' },
  { file: '.webm', program: 'Chromium 147', seen: 'every frame at its own time, same as the viewport' },
  { file: '.webm', program: 'ffmpeg 5.1.9', seen: 'all frames; 38 dB PSNR from the PNGs at 640 × 360' },
  { file: '.gif, .png', program: 'Chromium 147', seen: 'the same; PNGs equal the viewport' },
  { file: '.mp4', program: 'Chromium 147', seen: 'every frame at its own time, same as the viewport' },
  { file: '.mp4', program: 'ffmpeg 5.1.9', seen: 'all frames; 35 dB PSNR from the PNGs at 640 × 360' },
  { file: '.mp4, .webm', program: 'players, Firefox, Safari', seen: 'not tested' },
];

export const READ_FROM: readonly TriedProgram[] = [
  {
    file: '.gltf .glb',
    program: 'ten files from several programs',
    seen: 'joints and vertices match the format’s own formulas',
  },
  {
    file: '.vrm',
    program: 'files made for the tests, 0.x and 1.0',
    seen: 'posed, keyed, retargeted, saved as text and GLB',
  },
  { file: '.fbx', program: 'Maya 2019 and 2020, Blender 2.79 and 3.3', seen: 'nodes and vertices match ufbx' },
  {
    file: '.fbx',
    program: 'files made in the style of Mixamo’s',
    seen: 'posed, keyed, retargeted, saved as text and GLB',
  },
  { file: '.fbx before 7.0', program: 'any', seen: 'refused, with advice' },
];

export function programsPage(): DialogContent {
  const body = element(
    'div',
    { class: 'programs' },
    element('p', {}, 'What was tested, with versions. Nothing else was tested.'),
    tableOf('Saved here', SAVED_FOR),
    tableOf('Opened here', READ_FROM),
  );
  return { title: 'Other programs', body, kind: 'programs-dialog' };
}

function tableOf(caption: string, rows: readonly TriedProgram[]): HTMLElement {
  const heading = (text: string) => element('th', { scope: 'col' }, text);
  return element(
    'table',
    {},
    element('caption', {}, caption),
    element('thead', {}, element('tr', {}, heading('File'), heading('Program'), heading('Result'))),
    element(
      'tbody',
      {},
      ...rows.map(({ file, program, seen }) =>
        element('tr', {}, element('th', { scope: 'row' }, file), element('td', {}, program), element('td', {}, seen)),
      ),
    ),
  );
}
