/** Texts that use all that their formats have, in few bytes. */
import { ODD_AMC, ODD_ASF } from '../../helpers/acclaim.ts';
import type { Subject } from './subjects.ts';

const SKIN = `positions 4 {
	0 0 0
	1 0 0.5
	0 1e-3 -2
	1 1 0
}
normals 4 { 0 0 1 0 0 1 0 0 1 0 0 1 }
skinweights 4 {
	1 0 1
	2 0 0.25 1 0.75
	0
	2 1 0.5 0 0.5
}
texcoords 4 { 0 0 1 0 0 1 1 1 }
material m { texture a b.png }
triangles 2 {
	0 1 2
	1 3 2
}
material c { color 1 0.5 0 }
triangles 1 { 0 1 3 }
bindings 2 {
	matrix { 1 0 0 0 1 0 0 0 1 0 0 0 }
	matrix {
		0 1 0
		-1 0 0
		0 0 1
		1 2 3
	}
}
`;

const BVH = `HIERARCHY
ROOT hips
{
	OFFSET 0 0 0
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT left leg: #1
	{
		OFFSET 1 -2.5 0
		CHANNELS 3 Zrotation Xrotation Yrotation
		End Site
		{
			OFFSET 0 -3 0
		}
	}
	JOINT head {
		OFFSET 0 1e1 0
		CHANNELS 1 Yrotation
		End Site { }
	}
}
MOTION
Frames: 3
Frame Time: .0333333
0 90 0 1 2 3 4 5 6 7
0.5 90.25 -0 1 2 3 4 5 6 7
1 91 1e-3 -180 2 3 4 5 6 7.125
`;

const BVH_TWO = `HIERARCHY\r
ROOT a\r
{\r
 OFFSET 0 0 0\r
 CHANNELS 1 Xrotation\r
}\r
ROOT b\r
{\r
 OFFSET 1 0 0\r
 CHANNELS 3 Xposition Yposition Zposition\r
 End Site20\r
 {\r
 }\r
}\r
MOTION\r
Frames:2\r
FrameTime:0.1\r
1 2 3\r
4\r
2 3 4 5\r
`;

export const MADE_TEXTS: readonly (readonly [Subject, string])[] = [
  ['asf', ODD_ASF],
  ['amc', ODD_AMC],
  [
    'skel',
    `balljoint root {
	offset 0 1 0
	boxmin -0.1 -.2 -1e-1
	boxmax 0.1 0.2 0.1
	rotxlimit -1.5 1.5
	limit rz 0 2
	pose 0.1 0 5
	order zyx
	role hips
	hingejoint a { offset 0 1 0 axis 0 0 1 length 2 pose 0.5 couple r #2.rx 0.5 0.1 }
	universaljoint b { order yx pose 1 2 }
	quaternionjoint q { pose 0 0 0.6 0.8 }
	compoundjoint c { dofs tx rz sy pose 1 2 3 limit tx -1 1 }
}
`,
  ],
  [
    'skel',
    `freejoint { order xzy pose 1 2 3 4 5 6
 prismaticjoint p { axis 1 1 0 limit t -1 1 }
 translationaljoint t { }
 screwjoint s { axis 0 1 0 pitch 2 }
 scalejoint u { mode volume axis 0 1 0 pose 2 }
 scalejoint w { mode xyz }
 shearjoint h { pose 0 0.5 0 }
 fixedjoint f { foo bar { 1 2 } }
}
balljoint second{offset 1 2 3}
`,
  ],
  ['skel', '1 0 0 1 45 2\n0.5 1 0 0 -90 0\n2 0 1 1 0 1 1e-3 0 1 0 720 0\n'],
  ['skel', '0.5 0.75 0.5 -1\n0 -0.14 -0.04 0\n0 -0.2 0.05 1\n-0.1 -0.02 0 0\n'],
  ['skel', '3\n0, 0, 0, 0, -1, hips\n1, 1, 2, 3, 2\n2, 1, 2, 3, 0 # knee\n'],
  ['axskel', '1 0 0 1 45 2\n0.5 1 0 0 -90 0\n2 0 1 1 0 1\n1e-3 0 1 0 720 0\n'],
  ['skin', SKIN],
  ['skin', 'positions 3 { 0 0 0 1 0 0 0 1 0 } triangles 1 { 0 1 2 }\r\n'],
  ['morph', 'positions 2 {\n\t0 1 2 3\n\t3 0.5 -0 1e3\n}\nnormals 1 { 3 0 0 1 }\n'],
  [
    'anim',
    `animation {
	range 0 2.5
	numchannels 3
	channel 0 {
		extrapolate constant cycle_offset
		keys 3 {
			0 1 flat linear
			1 -2.5 smooth 0.25
			2.5 1e-3 -1 smooth
		}
	}
	channel { extrapolate bounce linear keys 1 { 0 0 flat flat } }
	channel { extrapolate cycle constant keys 2 { 1 2 linear linear 1 3 smooth smooth } }
}
`,
  ],
  [
    'rig',
    'rig wasp {\n\tskeleton a.skel\n\tskin "b c.skin"\n\tmorphs 2 { d.morph e f.morph }\n\tanimation g.anim\n}\n',
  ],
  ['bvh', BVH],
  ['bvh', BVH_TWO],
  ['bvh', BVH.replace('OFFSET 1 -2.5 0', 'OFFSET 1 -2.5 0 10 -20 3e1').replace('-3 0', '-3 0 1 2 3')],
  ['bvh', 'HIERARCHY ROOT{ JOINT{ JOINT a\n{ OFFSET 1 2 3 CHANNELS 0 } } }\nMOTION\nFrames: 0\nFrame Time: 1\n'],
  [
    'pose',
    'pose rest {\n\troot 0 1 0\n\tjoint hip { rx 1 ry 0 }\n\tjoint arm { r 0.5 }\n\tweight 0.25 smile\n}\npose b { }\n',
  ],
  ['markers.json', '[ { "time": 1.2, "label": "step" }, { "time": 2, "end": 3.5, "label": "stand" }, {"time": -0} ]'],
  [
    'sets.json',
    '{ "sets": [ { "name": "arm", "color": "#4a90e2", "joints": ["arm", "#7"], "note": [-0] } ], "locked": [ { "joint": "hip", "dofs": ["rx"] } ] }',
  ],
  [
    'layers.json',
    '{ "base": "a.base.anim", "flattened": { "file": "a.anim", "sha256": "00" }, "layers": [ { "name": "arm", "file": "a.arm.anim", "mode": "additive", "weight": { "extrapolate": ["cycle", "linear"], "keys": [[0, -0, "flat", 1e3], [1, 1, "smooth", "linear"]] }, "joints": ["hip", "#7"], "note": [null] } ] }',
  ],
  [
    'limbs.json',
    '{ "limbs": [ { "name": "leg", "joints": ["hip", "#7", "foot"], "tip": [0, -0, 1e-3], "orient": true, "bend": { "dof": "rx", "sign": -1 }, "note": [null] } ], "base": "a.base.anim", "flattened": { "file": "a.anim", "sha256": "00" }, "goals": [ { "limb": "leg", "space": [[0, "world"], [1, "#2"]], "channels": { "blend": 1, "tx": { "extrapolate": ["cycle", "linear"], "keys": [[0, -0, "flat", 1e3], [1, 1, "smooth", "linear"]] }, "qx": 3 } } ] }',
  ],
  [
    'attach.json',
    '{ "base": "a.base.anim", "flattened": { "file": "a.anim", "sha256": "00" }, "attached": [ { "character": "b", "joint": "#1", "span": [0, -0, 1e3], "offset": { "position": [0, -0, 1e-3], "rotation": [1, 2, 3], "note": null }, "tag": [1] } ], "version": 1 }',
  ],
  [
    'txt',
    'frame 0 time 1.5\nworld joint 0 (root):\n[1, 0, 0, 0]\n[0, 1, 0, 0]\n[0 0 1 0]\n0 0 0 1\nlocal:\n1 2 3\n4 5 6\nvertex 0: (1.0, -2e-3, nan)\n',
  ],
  ['csv', 'time,rx,ry,rz\n0,1,2,3\n0.5,4,5,6\n1,7,8,9\n'],
  ['csv', 'frame,time,a.x,a.y,a.z,b_X,b_Y,b_Z\n0,0,1,2.5,-3,4,5,6\n1,0.02,1e-3,2,3,,,\n2,0.04,nan,NaN,,7,8,9\n'],
  ['csv', 'frame,name,x,y,z,score\r\n0,a,1,2,3,0.5\r\n0,"b c",4,5,6,1\r\n2,a,1,2.5,3,\r\n5,b c,,,,\r\n'],
  [
    'csv',
    `frame,landmark,x,y,z\n${[0, 1].flatMap((f) => Array.from({ length: 33 }, (_, p) => `${f},${p},${p % 4},${p},${f}`)).join('\n')}\n`,
  ],
  [
    'trc',
    'PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n60.00\t60\t3\t2\tmm\nFrame#\tTime\tA b\t\t\tC\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n1\t0\t1\t2.5\t-3\t4\t5\t6\n2\t0.0167\t1e-3\t2\t3\t\t\t\n3\t0.0333\tNaN\tNaN\tNaN\t7\t8\t9\n',
  ],
  [
    'json',
    '{"time": 1.5, "world": [[1,0,0,0,0,1,0,0,0,0,1,0,1,2,3,1],[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]], "dofs": [1,2]}',
  ],
  ['obj', '# o\nv 0 0 0\nv 1 0.5 -1e-2\nv 1 1 1\nvn 0 0 1\nf 1 2 3\n'],
  [
    'ply',
    'ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 2 3\n3 0 1 0\n',
  ],
  [
    'settings.json',
    '{"theme":"dark","display":{"skin":"wire","ghostsBefore":3},"keys":{"play":["Space"]},"folds":{"a":true}}',
  ],
  [
    'gltf',
    '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"a","mesh":0,"children":[1]},{"translation":[0,1,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,1]}]}',
  ],
];
