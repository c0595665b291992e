/**
 * three.js without what nothing here is drawn with: headsets, environment maps, and in its shaders the lights, maps and
 * materials that no object has. A bundler cannot see that by itself, for the renderer finds all of them by name as it
 * runs. That is a seventh of three.js, gzipped.
 *
 * What is left out says so where it is reached all the same: modules throw, shaders do not compile (`#error`). Whoever
 * needs one of these takes it off its list.
 */
import type { Plugin } from 'vite';

const SOURCE = '/node_modules/three/src/';
const SHADERS = `${SOURCE}renderers/shaders/`;
const leftOut = (what: string) => `${what} is left out of the build: see vite.three.ts`;

/** Of materials that no object has. */
const SHADER_FILES = [
  'ShaderChunk/lights_phong_pars_fragment',
  'ShaderChunk/lights_toon_pars_fragment',
  'ShaderLib/background',
  'ShaderLib/backgroundCube',
  'ShaderLib/cube',
  'ShaderLib/equirect',
  'ShaderLib/linedashed',
  'ShaderLib/meshlambert',
  'ShaderLib/meshmatcap',
  'ShaderLib/meshphong',
  'ShaderLib/meshtoon',
  'ShaderLib/sprite',
  'ShaderLib/vsm',
];

/** Macros that three.js defines for features that no object has, or counts that are 0. */
const MACROS = [
  'NUM_CLIPPING_PLANES',
  'NUM_LIGHT_PROBE_GRIDS',
  'NUM_POINT_LIGHTS',
  'NUM_POINT_LIGHT_SHADOWS',
  'NUM_RECT_AREA_LIGHTS',
  'NUM_SPOT_LIGHTS',
  'NUM_SPOT_LIGHT_COORDS',
  'NUM_SPOT_LIGHT_MAPS',
  'NUM_SPOT_LIGHT_SHADOWS',
  'NUM_SUN_LIGHTS',
  'NUM_SUN_LIGHT_SHADOWS',
  'USE_ALPHAHASH',
  'USE_ANISOTROPY',
  'USE_AOMAP',
  'USE_BATCHING',
  'USE_BUMPMAP',
  'USE_CLEARCOAT',
  'USE_CLEARCOATMAP',
  'USE_CLEARCOAT_NORMALMAP',
  'USE_CLEARCOAT_ROUGHNESSMAP',
  'USE_DIFFUSE_ROUGHNESS',
  'USE_DISPERSION',
  'USE_DISPLACEMENTMAP',
  'USE_ENVMAP',
  'USE_FOG',
  'USE_IRIDESCENCE',
  'USE_LIGHTMAP',
  'USE_LOGARITHMIC_DEPTH_BUFFER',
  'USE_NORMALMAP',
  'USE_NORMALMAP_OBJECTSPACE',
  'USE_NORMALMAP_TANGENTSPACE',
  'USE_RETROREFLECTION',
  'USE_SHEEN',
  'USE_TRANSMISSION',
];

/** Modules, as paths in three.js's `src/`, and what takes their place. */
const MODULES: Readonly<Record<string, string>> = {
  'extras/PMREMGenerator.js': thrower('PMREMGenerator'),
  'renderers/WebGLCubeRenderTarget.js': thrower('WebGLCubeRenderTarget'),
  'renderers/webgl/WebGLOutput.js': thrower('WebGLOutput'),
  // The renderer makes one of each, and asks it every frame.
  'renderers/webgl/WebGLUniformsGroups.js': `
    const fail = () => { throw new Error(${JSON.stringify(leftOut('WebGLUniformsGroups'))}); };
    export const WebGLUniformsGroups = function () { return { bind: fail, update: fail, dispose() {} }; };`,
  'renderers/webxr/WebXRManager.js': `
    import { EventDispatcher } from '../../core/EventDispatcher.js';
    export class WebXRManager extends EventDispatcher {
      isPresenting = false;
      get enabled() { return false; }
      set enabled(on) { if (on) throw new Error(${JSON.stringify(leftOut('WebXRManager'))}); }
      getEnvironmentBlendMode() {}
      setAnimationLoop() {}
      dispose() {}
    }`,
};

function thrower(name: string): string {
  return `export class ${name} { constructor() { throw new Error(${JSON.stringify(leftOut(name))}); } }`;
}

/** Takes three.js from its sources, module by module, and the above out of it. */
export function leanThree(): Plugin {
  const unseen = new Set([...SHADER_FILES, ...MACROS, ...Object.keys(MODULES)]);
  return {
    name: 'lean-three',
    apply: 'build',
    enforce: 'pre',
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: 'three/src/Three.js' }] } }),
    load(id) {
      const path = id.split(SOURCE)[1] ?? '';
      if (Object.hasOwn(MODULES, path)) {
        unseen.delete(path);
        return MODULES[path];
      }
      const shader = id.split(SHADERS)[1]?.replace('.glsl.js', '') ?? '';
      if (!SHADER_FILES.includes(shader)) return;
      unseen.delete(shader);
      const error = JSON.stringify(`#error ${leftOut(shader)}`);
      return `export default ${error}; export const vertex = ${error}, fragment = ${error};`;
    },
    transform(code, id) {
      if (!id.includes(SHADERS)) return;
      const short = code.replace(/\/\* glsl \*\/`([^`]*)`/g, (_, glsl: string) => `\`${leaner(glsl, unseen)}\``);
      return { code: short, map: null };
    },
    buildEnd(error) {
      // A later three.js may have renamed it, and would bring it back unnoticed.
      if (!error && unseen.size > 0) this.error(`vite.three.ts: three.js has no ${[...unseen].join(', ')} any more`);
    },
  };
}

/**
 * GLSL without comments, indentation and what is compiled only if one of the macros is defined, or above 0.
 * @param unseen the macros found are taken out of it
 */
export function leaner(glsl: string, unseen = new Set<string>()): string {
  const kept: string[] = [];
  /** How many conditions deep the lines are that go; 0: they stay. */
  let skipped = 0;
  for (const line of glsl.replace(/\/\*[\s\S]*?\*\//g, '').split('\n')) {
    const text = line.replace(/\/\/.*/, '').trim();
    if (!text) continue;
    if (skipped > 0) {
      if (/^#\s*if/.test(text)) skipped++;
      else if (/^#\s*endif/.test(text) || (skipped === 1 && /^#\s*el/.test(text))) skipped--;
      if (skipped > 0) continue;
    }
    kept.push(text);
    const macro = neededMacro(text);
    if (!macro) continue;
    unseen.delete(macro);
    // In small letters, for three.js writes numbers in the place of names like NUM_SPOT_LIGHTS.
    kept.push(`#error ${leftOut(macro.toLowerCase())}`);
    skipped = 1;
  }
  return kept.join('\n');
}

/** Which of the macros has to be there for what follows a condition to be compiled at all. */
function neededMacro(line: string): string | undefined {
  if (!/^#\s*(if|ifdef|elif)\b/.test(line) || /\|\||[!=<]/.test(line)) return undefined;
  return MACROS.find((macro) => new RegExp(`\\b${macro}\\b`).test(line));
}
