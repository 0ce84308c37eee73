/* The solid in WebGL: surface of cells, faces of cracks, spheres, broken beams as discs, rigid bodies. */
const SPHERE_VERTEX = `
attribute float radius;
varying vec3 shade; varying float size; varying float front;
uniform float pixels; uniform vec4 cut;
void main() {
    vec4 place = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * place;
    gl_PointSize = 2.0 * radius * pixels;
    shade = color; size = radius;
    front = dot(position, cut.xyz) + cut.w;
}`;
const SPHERE_FRAGMENT = `
varying vec3 shade; varying float size; varying float front;
uniform mat4 projection;
void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float rest = 1.0 - dot(at, at);
    if (rest < 0.0 || front < 0.0) discard;
    vec3 normal = vec3(at.x, -at.y, sqrt(rest));
    gl_FragColor = vec4(shade * (0.55 + 0.45 * max(dot(normal, normalize(vec3(-0.4, 0.6, 1.0))), 0.0)), 1.0);
    gl_FragDepth = gl_FragCoord.z + 0.5 * projection[2][2] * size * normal.z;
}`;
const DISC_CORNERS = 8;

class Solid {
    constructor(three, head, buffer) {
        this.three = three;
        this.head = head;
        this.group = new three.Group();
        this.cut = new three.Plane(new three.Vector3(1, 0, 0), 1e9);
        this.read(new Reader(buffer));
        this.makeFaces();
        if (head.spheres) this.makeSpheres();
    }

    read(reader) {
        const h = this.head, n = h.n_points;
        const parts = [0, 1, 2].map(() => reader.int16(n));
        this.place = new Float32Array(3 * n);
        for (let c = 0; c < 3; ++c)
            for (let p = 0; p < n; ++p) this.place[3 * p + c] = h.low[c] + h.step * (parts[c][p] & 65535);
        this.owner = reader.int32(n);
        this.faceOwner = reader.int32(h.n_faces);
        this.faceCount = reader.int32(h.n_faces);
        this.corner = reader.int32(h.n_corners);
        this.radius = h.spheres ? reader.float32(n) : null;
        this.moved = new Float32Array(3 * n);
    }

    /* Every corner of a face is a vertex of its own; faces are fans of triangles in the order of their birth. */
    makeFaces() {
        const three = this.three, h = this.head, index = new Uint32Array(3 * (h.n_corners - 2 * h.n_faces));
        this.vertexOwner = new Int32Array(h.n_corners);
        this.indexEnd = new Uint32Array(h.n_faces + 1);
        for (let f = 0, first = 0, at = 0; f < h.n_faces; first += this.faceCount[f++]) {
            this.vertexOwner.fill(this.faceOwner[f], first, first + this.faceCount[f]);
            for (let k = 1; k + 1 < this.faceCount[f]; ++k) {
                index[at++] = first;
                index[at++] = first + k;
                index[at++] = first + k + 1;
            }
            this.indexEnd[f + 1] = at;
        }
        this.position = new three.BufferAttribute(new Float32Array(3 * h.n_corners), 3);
        this.colour = new three.BufferAttribute(new Float32Array(3 * h.n_corners), 3);
        const mesh = (offset) => {
            const geometry = new three.BufferGeometry();
            geometry.setIndex(new three.BufferAttribute(index, 1));
            geometry.setAttribute("position", this.position);
            geometry.setAttribute("color", this.colour);
            const material = new three.MeshLambertMaterial({
                vertexColors: true,
                flatShading: true,
                side: three.DoubleSide,
                clippingPlanes: [this.cut],
                polygonOffset: offset > 0,
                polygonOffsetFactor: offset,
                polygonOffsetUnits: offset
            });
            const made = new three.Mesh(geometry, material);
            made.frustumCulled = false;
            this.group.add(made);
            return made;
        };
        this.outside = mesh(0);
        this.cracks = mesh(1);
    }

    makeSpheres() {
        const three = this.three, all = [];
        for (let p = 0; p < this.radius.length; ++p)
            if (this.radius[p] > 0) all.push(p);
        this.spherePoint = Int32Array.from(all);
        const geometry = new three.BufferGeometry();
        this.spherePlace = new three.BufferAttribute(new Float32Array(3 * all.length), 3);
        this.sphereColour = new three.BufferAttribute(new Float32Array(3 * all.length), 3);
        geometry.setAttribute("position", this.spherePlace);
        geometry.setAttribute("color", this.sphereColour);
        geometry.setAttribute("radius", new three.BufferAttribute(Float32Array.from(all, (p) => this.radius[p]), 1));
        this.sphereMaterial = new three.ShaderMaterial({
            vertexShader: SPHERE_VERTEX,
            fragmentShader: SPHERE_FRAGMENT,
            vertexColors: true,
            uniforms: {
                pixels: {value: 1},
                cut: {value: new three.Vector4(0, 0, 0, 1)},
                projection: {value: new three.Matrix4()}
            }
        });
        this.spheres = new three.Points(geometry, this.sphereMaterial);
        this.spheres.frustumCulled = false;
        this.group.add(this.spheres);
    }

    /* Discs between the spheres of broken beams: numbers and ends as report_discs.h has them. */
    addDiscs(head, buffer) {
        const three = this.three, reader = new Reader(buffer), n = head.n;
        const number = reader.float32(7 * n);
        this.discEnds = reader.plainInt32(2 * n);
        this.discRow = reader.plainInt32(n);
        this.pointOf = new Map(Array.from(this.owner, (element, p) => [element, p]));
        this.discShape = new Float32Array(3 * DISC_CORNERS * n);
        const index = new Uint32Array(3 * (DISC_CORNERS - 2) * n);
        const normal = new three.Vector3(), along = new three.Vector3(), across = new three.Vector3();
        for (let d = 0, at = 0; d < n; ++d) {
            const [x, y, z, nx, ny, nz, radius] = number.subarray(7 * d, 7 * d + 7);
            normal.set(nx, ny, nz);
            along.set(Math.abs(nx) < 0.7 ? 1 : 0, Math.abs(nx) < 0.7 ? 0 : 1, 0).cross(normal).normalize();
            across.crossVectors(normal, along);
            for (let k = 0; k < DISC_CORNERS; ++k) {
                const c = radius * Math.cos(2 * Math.PI * k / DISC_CORNERS),
                      s = radius * Math.sin(2 * Math.PI * k / DISC_CORNERS);
                this.discShape.set(
                    [x + c * along.x + s * across.x, y + c * along.y + s * across.y, z + c * along.z + s * across.z],
                    3 * (DISC_CORNERS * d + k));
            }
            for (let k = 1; k + 1 < DISC_CORNERS; ++k)
                for (const corner of [0, k, k + 1]) index[at++] = DISC_CORNERS * d + corner;
        }
        this.discs = this.plain(this.discShape.length / 3, index, {color: 0xb2332b});
    }

    plain(n, index, colour) {
        const three = this.three, geometry = new three.BufferGeometry();
        geometry.setIndex(new three.BufferAttribute(index, 1));
        geometry.setAttribute("position", new three.BufferAttribute(new Float32Array(3 * n), 3));
        const material = new three.MeshLambertMaterial(
            {...colour, flatShading: true, side: three.DoubleSide, clippingPlanes: [this.cut]});
        const made = new three.Mesh(geometry, material);
        made.frustumCulled = false;
        this.group.add(made);
        return made;
    }

    addRigid(head, buffer) {
        const reader = new Reader(buffer);
        this.rigidPlace = reader.float32(3 * head.n_points);
        const index = Uint32Array.from(reader.plainInt32(3 * head.n_triangles));
        this.rigid =
            this.plain(head.n_points, index, {color: 0x9aa3ad, transparent: true, opacity: 0.55, depthWrite: false});
    }

    /* A frame unpacked: displacement of points [m] and fields of elements. */
    moment(buffer) {
        const reader = new Reader(buffer), h = this.head;
        const parts = [0, 1, 2].map(() => reader.int16(h.n_points)), n = h.n_elements;
        const displacement = new Float32Array(3 * h.n_points);
        for (let c = 0; c < 3; ++c)
            for (let p = 0; p < h.n_points; ++p) displacement[3 * p + c] = h.displacement_step * parts[c][p];
        const out = {displacement, stress: reader.take(n), speed: reader.take(n)};
        if (h.fracture) {
            out.damage = reader.take(n);
            const two = reader.take(2 * n);
            out.fragment = Uint16Array.from({length: n}, (_, e) => two[2 * e] << 8 | two[2 * e + 1]);
        }
        return out;
    }

    /* Move everything to a frame: scale: factor on the displacement; rigid: of rigid bodies at that frame, or null. */
    move(frame, moment, scale, rigid) {
        const u = moment.displacement;
        for (let k = 0; k < this.moved.length; ++k) this.moved[k] = this.place[k] + scale * u[k];
        const copy = (points, to) => {
            for (let v = 0; v < points.length; ++v)
                for (let c = 0; c < 3; ++c) to.array[3 * v + c] = this.moved[3 * points[v] + c];
            to.needsUpdate = true;
        };
        copy(this.corner, this.position);
        if (this.spheres) copy(this.spherePoint, this.spherePlace);
        const first = this.indexEnd[this.head.frames[0].faces], open = this.indexEnd[this.head.frames[frame].faces];
        this.outside.geometry.setDrawRange(0, first);
        this.cracks.geometry.setDrawRange(first, open - first);
        if (this.discs) this.moveDiscs(frame, u, scale);
        if (this.rigid && rigid) {
            const attribute = this.rigid.geometry.attributes.position;
            for (let k = 0; k < rigid.length; ++k) attribute.array[k] = this.rigidPlace[k] + scale * rigid[k];
            attribute.needsUpdate = true;
            this.rigid.geometry.computeBoundingSphere();
        }
    }

    moveDiscs(frame, u, scale) {
        const attribute = this.discs.geometry.attributes.position, broken = this.head.frames[frame].broken;
        let shown = 0;
        for (let d = 0; d < this.discRow.length; ++d) {
            if (this.discRow[d] < broken) shown = d + 1;
            const i = this.pointOf.get(this.discEnds[2 * d]), j = this.pointOf.get(this.discEnds[2 * d + 1]);
            for (let k = 3 * DISC_CORNERS * d; k < 3 * DISC_CORNERS * (d + 1); ++k)
                attribute.array[k] = this.discShape[k] + scale * 0.5 * (u[3 * i + k % 3] + u[3 * j + k % 3]);
        }
        attribute.needsUpdate = true;
        this.discs.geometry.setDrawRange(0, 3 * (DISC_CORNERS - 2) * shown);
    }

    /* Colour everything: of(element, point) writes a colour into `out` from place `at`. */
    paint(of) {
        const to = this.colour.array;
        for (let v = 0; v < this.vertexOwner.length; ++v) of(this.vertexOwner[v], this.corner[v], to, 3 * v);
        this.colour.needsUpdate = true;
        if (!this.spheres) return;
        for (let s = 0; s < this.spherePoint.length; ++s)
            of(this.owner[this.spherePoint[s]], this.spherePoint[s], this.sphereColour.array, 3 * s);
        this.sphereColour.needsUpdate = true;
    }

    /* Hide what lies beyond `at` along an axis; axis -1: nothing is hidden. */
    setCut(axis, at) {
        this.cut.normal.set(axis === 0 ? -1 : 0, axis === 1 ? -1 : 0, axis === 2 ? -1 : 0);
        this.cut.constant = axis < 0 ? 1 : at;
        if (this.spheres) this.sphereMaterial.uniforms.cut.value.set(...this.cut.normal.toArray(), this.cut.constant);
    }
}
