/** The tentacle as a mesh of three.js: four influences a vertex, morphs as its own attributes, quaternion tracks. */
import {
  AnimationClip,
  AnimationMixer,
  Bone,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Euler,
  type Group,
  MeshStandardMaterial,
  NumberKeyframeTrack,
  Quaternion,
  QuaternionKeyframeTrack,
  Skeleton,
  SkinnedMesh,
} from 'three';
import {
  angleOf,
  INFLUENCES,
  JOINT_LENGTH,
  JOINTS,
  KEYS,
  MORPHS,
  SECONDS,
  type Tentacle,
  tentacle,
  timeOf,
  weightOf,
} from '../scenes/tentacle.ts';

/** @param vertices as for `tentacle` */
export function addTentacle(content: Group, vertices: number): AnimationMixer {
  const bones = Array.from({ length: JOINTS }, (_, j) => {
    const bone = new Bone();
    bone.name = `j${j}`;
    bone.position.y = j === 0 ? 0 : JOINT_LENGTH;
    return bone;
  });
  for (let j = 1; j < JOINTS; j++) bones[j - 1].add(bones[j]);
  const mesh = new SkinnedMesh(geometryOf(tentacle(vertices)), new MeshStandardMaterial({ side: DoubleSide }));
  mesh.add(bones[0]);
  mesh.bind(new Skeleton(bones));
  content.add(mesh);
  const mixer = new AnimationMixer(mesh);
  mixer.clipAction(take()).play();
  return mixer;
}

function geometryOf({ positions, normals, joints, weights, triangles, morphs }: Tentacle): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setAttribute('skinIndex', new BufferAttribute(joints, INFLUENCES));
  geometry.setAttribute('skinWeight', new BufferAttribute(weights, INFLUENCES));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  geometry.morphTargetsRelative = true;
  geometry.morphAttributes.position = morphs.map(({ vertices, positions: moved }) => {
    const deltas = new Float32Array(positions.length);
    vertices.forEach((v, i) => {
      for (let k = 0; k < 3; k++) deltas[3 * v + k] = moved[3 * i + k] - positions[3 * v + k];
    });
    return new BufferAttribute(deltas, 3);
  });
  return geometry;
}

function take(): AnimationClip {
  const keys = Array.from({ length: KEYS }, (_, k) => k);
  const times = keys.map(timeOf);
  const turned = (joint: number, key: number) => {
    const [x, y, z] = [0, 1, 2].map((axis) => angleOf(joint, axis, key));
    // The page turns about x first, in the axes of the parent.
    return new Quaternion().setFromEuler(new Euler(x, y, z, 'ZYX')).toArray();
  };
  const turns = Array.from({ length: JOINTS }, (_, j) => {
    return new QuaternionKeyframeTrack(
      `j${j}.quaternion`,
      times,
      keys.flatMap((key) => turned(j, key)),
    );
  });
  const morphs = Array.from({ length: MORPHS }, (_, m) => {
    return new NumberKeyframeTrack(
      `.morphTargetInfluences[${m}]`,
      times,
      keys.map((key) => weightOf(m, key)),
    );
  });
  return new AnimationClip('swing', SECONDS, [...turns, ...morphs]);
}
