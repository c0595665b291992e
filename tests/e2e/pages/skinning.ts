/**
 * Reads back what a real GPU makes of skinning: vertices from the vertex shader, in floats, and pictures, in bytes. The
 * page's side of `../skinning.test.ts`.
 */
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Camera,
  DirectionalLight,
  DoubleSide,
  FloatType,
  GLSL3,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  OrthographicCamera,
  PlaneGeometry,
  Points,
  RGBAFormat,
  Scene,
  ShaderMaterial,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { readMorph } from '../../../src/formats/morph/read.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import type { Morph } from '../../../src/model/morph.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../src/model/session.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import type { MarrowSkinnedMesh } from '../../../src/view/skin/skinned-mesh.ts';
import { PLAIN_SKIN, placeOne, withExactSkinning } from '../../../src/view/skin/skinning.ts';

/** Files as text, with what to do with them. */
export interface Case {
  readonly skel?: string;
  readonly skin: string;
  readonly morphs?: readonly string[];
  /** All of the character's DOFs; not clamped. */
  readonly pose: readonly number[];
  /** Number of additional morphs that move nothing. */
  readonly idleMorphs?: number;
  /** A texture for the skin, from a canvas: whether it is there. */
  readonly winding?: 'as given' | 'reversed' | 'mixed';
  readonly texture?: { readonly name: string; readonly mime: string; readonly base64: string };
}

export interface Vertices {
  /** From the GPU. */
  readonly positions: number[];
  readonly normals: number[];
  /** From `getVertexPosition`. */
  readonly asked: number[];
}

export interface Picture {
  /** RGBA, bottom row first, in base64: a list of so many numbers takes seconds on its way. */
  readonly pixels: string;
  readonly drawn: number;
}

const SIZE = 160;
const renderer = new WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
const skins = new DrawnSkins();
renderer.setSize(SIZE, SIZE, false);
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);

function needed<T>(read: { readonly value?: T; readonly diagnostics: readonly { readonly message: string }[] }): T {
  if (read.value === undefined) throw new Error(read.diagnostics.map((d) => d.message).join(' '));
  return read.value;
}

function characterOf(what: Case): Character {
  const skin = needed(readSkin(what.skin, 'a.skin'));
  const none = { indices: new Uint32Array(0), values: new Float64Array(0) };
  const morphs: Morph[] = (what.morphs ?? []).map((text) => needed(readMorph(text, 'a.morph')));
  for (let i = 0; i < (what.idleMorphs ?? 0); i++) morphs.push({ name: `${i}`, positions: none, normals: none });
  const triangles = skin.triangles.slice();
  for (let t = 0; t < triangles.length; t += 3) {
    if (what.winding === 'reversed' || (what.winding === 'mixed' && (t / 3) % 2)) {
      [triangles[t], triangles[t + 1]] = [triangles[t + 1], triangles[t]];
    }
  }
  const texture = what.texture && {
    name: what.texture.name,
    mime: what.texture.mime,
    bytes: Uint8Array.from(atob(what.texture.base64), (c) => c.charCodeAt(0)),
  };
  return {
    id: 'c',
    name: 'c',
    ...(what.skel ? { skeleton: needed(readSkel(what.skel, 'a.skel'))[0] } : {}),
    skins: [{ ...skin, triangles }],
    shownSkin: 0,
    morphs,
    textures: texture ? [texture] : [],
    takes: [],
    shownTake: -1,
    pose: [...what.pose, ...new Array(what.idleMorphs ?? 0).fill(0)],
    clampsToLimits: false,
    placements: [DEFAULT_PLACEMENT],
    timeOffsetSeconds: 0,
    sources: [],
  };
}

/** Points skinned like a mesh, one pixel each. */
class SkinnedPoints extends Points {
  readonly isSkinnedMesh = true;
  readonly skeleton: MarrowSkinnedMesh['skeleton'];
  readonly bindMatrix = new Matrix4();
  readonly bindMatrixInverse = new Matrix4();

  constructor(mesh: MarrowSkinnedMesh, material: ShaderMaterial) {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(mesh.geometry.attributes)) geometry.setAttribute(name, attribute);
    super(geometry, material);
    this.skeleton = mesh.skeleton;
    this.frustumCulled = false;
  }
}

/** One pixel per vertex, row by row; the fragment shader outputs `what`. */
const READ_BACK = (what: string) => /* glsl */ `
flat out vec3 vValue;
#include <common>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
void main() {
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	vValue = ${what};
	vec2 pixel = vec2( float( gl_VertexID % 64 ), float( gl_VertexID / 64 ) ) + 0.5;
	gl_Position = vec4( pixel / vec2( 64.0, 64.0 ) * 2.0 - 1.0, 0.0, 1.0 );
	gl_PointSize = 1.0;
}`;

function readBack(mesh: MarrowSkinnedMesh, what: string): number[] {
  const material = withExactSkinning(
    new ShaderMaterial({
      glslVersion: GLSL3,
      depthTest: false,
      vertexShader: READ_BACK(what),
      fragmentShader: 'flat in vec3 vValue;\nout vec4 pixel;\nvoid main() { pixel = vec4( vValue, 1.0 ); }',
    }),
    mesh.shared,
    { placing: 'one' },
  );
  placeOne(material, mesh.skeleton);
  const target = new WebGLRenderTarget(64, 64, { type: FloatType, format: RGBAFormat });
  const scene = new Scene();
  scene.add(new SkinnedPoints(mesh, material));
  renderer.setRenderTarget(target);
  renderer.render(scene, new Camera());
  renderer.setRenderTarget(null);
  const pixels = new Float32Array(4 * 64 * 64);
  renderer.readRenderTargetPixels(target, 0, 0, 64, 64, pixels);
  const count = mesh.geometry.getAttribute('position').count;
  const out: number[] = [];
  for (let v = 0; v < count; v++) out.push(pixels[4 * v], pixels[4 * v + 1], pixels[4 * v + 2]);
  target.dispose();
  material.dispose();
  return out;
}

function vertices(what: Case): Vertices {
  const view = new CharacterView(skins, renderer);
  view.show(characterOf(what), DEFAULT_DISPLAY, undefined);
  const [mesh] = view.skinnedMeshes;
  const out = {
    positions: readBack(mesh, 'transformed'),
    normals: readBack(mesh, 'objectNormal'),
    asked: [...view.vertices()],
  };
  view.dispose();
  return out;
}

/** A camera that looks at a box's centre, from the front and slightly above. */
function cameraFor(centre: Vector3, radius: number): OrthographicCamera {
  const camera = new OrthographicCamera(-radius, radius, radius, -radius, 0, 6 * radius);
  camera.position.copy(centre).add(new Vector3(0.6, 0.5, 1).setLength(3 * radius));
  camera.lookAt(centre);
  return camera;
}

/** Two lights, and a floor that receives shadows. */
function stage(centre: Vector3, radius: number): Scene {
  const scene = new Scene();
  const light = new DirectionalLight(0xffffff, 3);
  light.position.copy(centre).add(new Vector3(1, 2, 1.5).setLength(4 * radius));
  light.target.position.copy(centre);
  light.castShadow = true;
  Object.assign(light.shadow.camera, {
    left: -2 * radius,
    right: 2 * radius,
    top: 2 * radius,
    bottom: -2 * radius,
    near: radius,
    far: 8 * radius,
  });
  light.shadow.camera.updateProjectionMatrix();
  const floor = new Mesh(new PlaneGeometry(20 * radius, 20 * radius), new MeshStandardMaterial());
  floor.rotation.x = -Math.PI / 2;
  floor.position.copy(centre).y -= radius;
  floor.receiveShadow = true;
  scene.add(new AmbientLight(0xffffff, 0.4), light, light.target, floor);
  return scene;
}

function picture(scene: Scene, camera: Camera): Picture {
  scene.onBeforeRender = (_renderer, _scene, seenBy) => skins.aim(seenBy, () => true);
  renderer.setClearColor(0x000000, 0);
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * SIZE * SIZE);
  gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let drawn = 0;
  for (let i = 3; i < pixels.length; i += 4) if (pixels[i] > 0) drawn++;
  let bytes = '';
  for (let i = 0; i < pixels.length; i += 0x8000) bytes += String.fromCharCode(...pixels.subarray(i, i + 0x8000));
  return { pixels: btoa(bytes), drawn };
}

/** A character's vertices deformed by the core, with normals and triangles as they are drawn. */
function deformed(character: Character, view: CharacterView): BufferGeometry {
  const [mesh] = view.skinnedMeshes;
  const [skin] = character.skins;
  const compiled = compileSkin(skin);
  const positions = skin.positions.slice();
  const normals = skin.positions.slice();
  blendMorphs(compiled, character.morphs, view.dofs, view.dofs.length - character.morphs.length, positions, normals);
  deform(compiled, character.skeleton && view.worldMatrices, positions, normals, positions, normals);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(mesh.geometry.getIndex());
  geometry.setAttribute('turned', mesh.geometry.getAttribute('turned'));
  return geometry;
}

/** The character as the page draws it, and its vertices deformed by the core and drawn as a rigid mesh. */
function pictures(what: Case): { readonly skinned: Picture; readonly rigid: Picture } {
  const character = characterOf(what);
  const view = new CharacterView(skins, renderer);
  view.show(character, { ...DEFAULT_DISPLAY, skin: 'solid' }, undefined);
  const [mesh] = view.skinnedMeshes;
  const geometry = deformed(character, view);
  const material = [mesh.material].flat()[0].clone();
  const rigid = new Mesh(geometry, withExactSkinning(material, PLAIN_SKIN, { placing: 'many' }));
  rigid.castShadow = true;
  // The rigid mesh's own sphere is exact; the character's is around its joints.
  geometry.computeBoundingSphere();
  const centre = geometry.boundingSphere?.center ?? new Vector3();
  const radius = geometry.boundingSphere?.radius ?? 1;
  const take = (...objects: Object3D[]) => {
    const scene = stage(centre, radius);
    scene.add(...objects);
    const taken = picture(scene, cameraFor(centre, 1.4 * radius));
    scene.remove(...objects);
    return taken;
  };
  const both = { skinned: take(view.object, skins.object), rigid: take(rigid) };
  view.dispose();
  return both;
}

/** The character alone in some style, after its texture has loaded. */
async function styled(what: Case, display: Partial<Display>, heatJoint?: number): Promise<Picture> {
  let came: (() => void) | undefined;
  const textured = new Promise<void>((resolve) => {
    came = resolve;
  });
  const view = new CharacterView(skins, renderer, {
    redraw: () => came?.(),
    textureFailed: () => came?.(),
  });
  view.show(characterOf(what), { ...DEFAULT_DISPLAY, ...display }, heatJoint);
  if (what.texture) await textured;
  const scene = new Scene();
  scene.add(new AmbientLight(0xffffff, 3), view.object, skins.object);
  const camera = cameraFor(view.localBox.getCenter(new Vector3()), view.localBox.getSize(new Vector3()).length() / 2);
  const taken = picture(scene, camera);
  view.dispose();
  return taken;
}

/** Shading normals in view space as colours: 0.5 + 0.5 n. `plain`: as oriented by three.js, by the file's winding. */
function turned(what: Case, plain: boolean): Picture {
  const view = new CharacterView(skins, renderer);
  const character = characterOf(what);
  view.show(character, DEFAULT_DISPLAY, undefined);
  const [mesh] = view.skinnedMeshes;
  const material = new ShaderMaterial({
    side: DoubleSide,
    vertexShader: /* glsl */ `
varying vec3 vViewPosition;
#include <common>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
void main() {
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	vViewPosition = - mvPosition.xyz;
}`,
    fragmentShader: /* glsl */ `
varying vec3 vViewPosition;
#include <common>
#include <normal_pars_fragment>
void main() {
	#include <normal_fragment_begin>
	gl_FragColor = vec4( 0.5 + 0.5 * normal, 1.0 );
}`,
  });
  const scene = new Scene();
  if (plain) {
    const geometry = deformed(character, view);
    geometry.setIndex(new BufferAttribute(mesh.shared.skin.triangles, 1));
    scene.add(new Mesh(geometry, material));
  } else {
    mesh.material = withExactSkinning(material, mesh.shared, { placing: 'one' });
    placeOne(material, mesh.skeleton);
    scene.add(mesh);
  }
  const camera = cameraFor(view.localBox.getCenter(new Vector3()), view.localBox.getSize(new Vector3()).length() / 2);
  const taken = picture(scene, camera);
  view.dispose();
  return taken;
}

export const harness = { vertices, pictures, styled, turned };
export type Harness = typeof harness;

declare global {
  interface Window {
    harness: Harness;
  }
}
window.harness = harness;
