// What the page of a replay uses of three.js 0.187.0 and uPlot 1.6.32. To make libraries.min.js:
//   npm i three@0.187.0 uplot@1.6.32 esbuild@0.28.2
//   npx esbuild libraries.js --bundle --minify --format=iife --global-name=lib --charset=ascii --outfile=libraries.min.js
export { AmbientLight, BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, DirectionalLight, EdgesGeometry, GridHelper, Group, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshStandardMaterial, PerspectiveCamera, Quaternion, Scene, SphereGeometry, Vector3, WebGLRenderer } from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
export { default as uPlot } from 'uplot';
