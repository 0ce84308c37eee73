/* The view of the solid with its controls. */
const CORNER_VIEW = [
    Math.cos(24 * Math.PI / 180) * Math.cos(-62 * Math.PI / 180),
    Math.cos(24 * Math.PI / 180) * Math.sin(-62 * Math.PI / 180), Math.sin(24 * Math.PI / 180)
];

class View {
    constructor(place, head, touching) {
        this.head = head;
        this.frame = head.frames.length - 1;
        this.moments = new Map();
        this.listeners = [];
        this.scale = touching ? 1 : 0;
        this.colouring = head.fracture ? 'damage' : 'stress';
        this.place = place;
    }

    async start(module) {
        const three = this.three = module.THREE;
        this.makeControls();
        three.ColorManagement.enabled = false;
        this.renderer = new three.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
        this.renderer.outputColorSpace = three.LinearSRGBColorSpace;
        this.renderer.localClippingEnabled = true;
        this.renderer.setClearColor(0xffffff);
        this.box.append(this.renderer.domElement, this.axes);
        this.scene = new three.Scene();
        this.camera = new three.OrthographicCamera(-1, 1, 1, -1, 0, 1);
        this.camera.up.set(0, 0, 1);
        this.scene.add(this.camera, new three.AmbientLight(0xffffff, 1.9));
        const lamp = new three.DirectionalLight(0xffffff, 1.4);
        lamp.position.set(-0.4, 0.6, 1);
        this.camera.add(lamp);
        this.solid = new Solid(three, this.head, await unpack('view-surface'));
        if (this.head.discs) this.solid.addDiscs(this.head.discs, await unpack('view-discs'));
        if (this.head.rigid) this.solid.addRigid(this.head.rigid, await unpack('view-rigid'));
        this.scene.add(this.solid.group);
        this.controls = new module.OrbitControls(this.camera, this.renderer.domElement);
        this.controls.addEventListener('change', () => this.draw());
        if (!this.scale) this.scale = await this.automaticScale();
        this.factor.value = this.scale;
        await this.show(this.frame);
        this.look(CORNER_VIEW);
        new ResizeObserver(() => this.resize()).observe(this.box);
        this.ready = true;
        this.drawNow();
    }

    /* The factor that makes the largest displacement at the end, less its mean, about 4 % of the diagonal. */
    async automaticScale() {
        const u = (await this.moment(this.frame)).displacement, n = u.length / 3, mean = [0, 0, 0];
        for (let k = 0; k < u.length; ++k) mean[k % 3] += u[k] / n;
        let most = 0;
        for (let p = 0; p < n; ++p)
            most = Math.max(most, Math.hypot(u[3 * p] - mean[0], u[3 * p + 1] - mean[1], u[3 * p + 2] - mean[2]));
        const wanted = 0.08 * this.bounds().radius / most;
        if (!(wanted >= 2) || !Number.isFinite(wanted)) return 1;
        const decade = 10 ** Math.floor(Math.log10(wanted));
        return decade * (wanted / decade < 2 ? 1 : wanted / decade < 5 ? 2 : 5);
    }

    bounds() {
        const box = new this.three.Box3().setFromArray(this.solid.place);
        return box.getBoundingSphere(new this.three.Sphere());
    }

    async moment(frame) {
        if (!this.moments.has(frame)) this.moments.set(frame, this.solid.moment(await unpack(`view-${frame}`)));
        return this.moments.get(frame);
    }

    async show(frame) {
        this.frame = frame;
        const moment = await this.moment(frame);
        const rigid = this.head.rigid ? new Float32Array(await unpack(`view-rigid-${frame}`)) : null;
        if (frame !== this.frame) return; /* another one was asked for meanwhile */
        this.solid.move(frame, moment, this.scale, rigid);
        this.paint(moment);
        this.slider.value = frame;
        this.drawNow();
        this.told.textContent = this.sentence(frame);
        for (const listener of this.listeners) listener(frame);
    }

    sentence(frame) {
        const f = this.head.frames[frame], parts = [`frame ${f.number}`];
        parts.push(
            f.time > 0 ? `t = ${words(f.time, 's')}` :
                         `stage ${f.stage + 1}, load ${Number(f.stage_time.toPrecision(4))}`);
        if (this.head.fracture)
            parts.push(`${f.broken} broken bonds`, `${f.fragments} fragment${f.fragments === 1 ? '' : 's'}`);
        return parts.join(' · ');
    }

    /* What colours the solid: [name, unit, least, most, value of an element or point as 0 to 255]. */
    field(moment) {
        const h = this.head, u = moment.displacement, most = h.displacement_step * 32767;
        const length = (p) => Math.hypot(u[3 * p], u[3 * p + 1], u[3 * p + 2]);
        return {
            stress: ['von Mises stress', 'Pa', h.most_stress, (e) => moment.stress[e]],
            speed: ['speed', 'm/s', h.most_speed, (e) => moment.speed[e]],
            displacement: ['displacement', 'm', most, (_, p) => Math.min(255, Math.round(255 * length(p) / most)) || 0],
            damage: ['damage', '-', 1, (e) => moment.damage[e]],
        }[this.colouring];
    }

    paint(moment) {
        if (this.colouring === 'fragment') {
            const largest = mostFrequent(moment.fragment), known = new Map();
            this.solid.paint((e, _, out, at) => {
                const number = moment.fragment[e];
                if (!known.has(number)) known.set(number, fragmentColour(number, largest));
                const colour = known.get(number);
                out[at] = colour[0];
                out[at + 1] = colour[1];
                out[at + 2] = colour[2];
            });
            this.bar.replaceChildren('one colour for each fragment, the largest grey');
            return;
        }
        const [name, unit, most, value] = this.field(moment);
        this.solid.paint((e, p, out, at) => {
            const level = 3 * value(e, p);
            out[at] = LADDER[level];
            out[at + 1] = LADDER[level + 1];
            out[at + 2] = LADDER[level + 2];
        });
        const stripe = make('i');
        stripe.style.background = ladderStyle();
        this.bar.replaceChildren(`${name}: 0`, stripe, words(most, unit));
    }

    /* With the next picture of the browser, once for however many asked. */
    draw() {
        if (this.asked) return;
        this.asked = requestAnimationFrame(() => {
            this.asked = 0;
            this.drawNow();
        });
    }

    drawNow() {
        if (!this.ready) return;
        if (this.solid.spheres) {
            const tall = this.renderer.domElement.height;
            this.solid.sphereMaterial.uniforms.pixels.value =
                tall * this.camera.zoom / (this.camera.top - this.camera.bottom);
            this.solid.sphereMaterial.uniforms.projection.value.copy(this.camera.projectionMatrix);
        }
        this.renderer.render(this.scene, this.camera);
        this.drawAxes();
    }

    drawAxes() {
        const pen = this.axes.getContext('2d'), turn = this.camera.matrixWorldInverse.elements;
        pen.clearRect(0, 0, 168, 168);
        pen.font = '24px sans-serif';
        pen.lineWidth = 3;
        pen.textBaseline = 'middle';
        pen.textAlign = 'center';
        [['x', '#b2332b'], ['y', '#2b7a3b'], ['z', '#2b4fb2']].forEach(([name, colour], c) => {
            const x = turn[4 * c], y = -turn[4 * c + 1];
            if (Math.hypot(x, y) < 0.15) return;
            pen.strokeStyle = pen.fillStyle = colour;
            pen.beginPath();
            pen.moveTo(84, 84);
            pen.lineTo(84 + 52 * x, 84 + 52 * y);
            pen.stroke();
            pen.fillText(name, 84 + 68 * x, 84 + 68 * y);
        });
    }

    /* From a direction, the whole solid in sight. */
    look(from) {
        const sphere = this.bounds();
        this.controls.target.copy(this.middle(from));
        this.camera.zoom = 1;
        this.camera.near = -20 * sphere.radius;
        this.camera.far = 20 * sphere.radius;
        this.camera.up.set(0, from[2] > 0.99 ? 1 : 0, from[2] > 0.99 ? 0 : 1);
        this.camera.position.copy(this.controls.target).addScaledVector(new this.three.Vector3(...from), sphere.radius);
        this.controls.update();
        this.fit();
    }

    /* The point of the solid that is in the middle of the picture, and how far it reaches to the side and up from
     * there. */
    middle(from) {
        const three = this.three, toward = new three.Vector3(...from).normalize();
        const up = new three.Vector3(0, toward.z > 0.99 ? 1 : 0, toward.z > 0.99 ? 0 : 1);
        const right = new three.Vector3().crossVectors(up, toward).normalize();
        up.crossVectors(toward, right);
        const reach = [right, up, toward].map((axis) => this.reachAlong(axis));
        this.half =
            [reach[0], reach[1]].map(([low, high]) => Math.max(0.5 * (high - low), 0.02 * this.bounds().radius));
        const out = new three.Vector3();
        [right, up, toward].forEach((axis, k) => out.addScaledVector(axis, 0.5 * (reach[k][0] + reach[k][1])));
        return out;
    }

    reachAlong(axis) {
        const at = this.solid.place;
        let low = Infinity, high = -Infinity;
        for (let k = 0; k < at.length; k += 3) {
            const x = at[k] * axis.x + at[k + 1] * axis.y + at[k + 2] * axis.z;
            low = Math.min(low, x);
            high = Math.max(high, x);
        }
        return [low, high];
    }

    resize() {
        if (this.box.clientWidth === this.size[0] && this.box.clientHeight === this.size[1]) return;
        this.fit();
    }

    fit() {
        const wide = this.box.clientWidth, tall = this.box.clientHeight;
        this.size = [wide, tall];
        const half = 1.15 * Math.max(this.half[1], this.half[0] * tall / wide);
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(wide, tall, false);
        this.camera.top = half;
        this.camera.bottom = -half;
        this.camera.right = half * wide / tall;
        this.camera.left = -this.camera.right;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    makeControls() {
        const h = this.head, n = h.frames.length;
        this.box = make('div', {className: 'solid'});
        this.axes = make('canvas', {className: 'axes', width: 168, height: 168});
        this.slider = make('input', {
            type: 'range',
            id: 'frame',
            min: 0,
            max: n - 1,
            step: 1,
            value: this.frame,
            ariaLabel: 'frame',
            oninput: () => this.show(Number(this.slider.value))
        });
        this.play = make('button', {textContent: 'play', onclick: () => this.run()});
        this.told = make('span', {id: 'moment'});
        this.bar = make('span', {className: 'bar'});
        this.place.append(
            make('h2', {textContent: 'View'}), this.makeChoices(), this.box,
            make('div', {className: 'time'}, this.play, this.slider),
            make('div', {className: 'controls'}, this.told, this.bar));
        const left = h.n_all - n;
        const some = left > 0 ? `${n} of the ${h.n_all} frames are shown; the folder of the run has all. ` : '';
        const thinned = h.discs && h.discs.every > 1 ? `Each disc stands for ${h.discs.every} broken bonds. ` : '';
        const cracks = h.n_dropped > 0 ? `${h.n_dropped} faces of cracks, of cells all over the body, are left out. ` : '';
        this.place.append(make('p', {
            className: 'small',
            textContent: `${some}${cracks}${thinned}Drag: turn; wheel: zoom; right button: move. ` +
                'Colours of stress and speed end where 99.5 % of the values do.'
        }));
    }

    makeChoices() {
        const h = this.head,
              names = [['stress', 'von Mises stress'], ['speed', 'speed'], ['displacement', 'displacement']];
        if (h.fracture) names.push(['damage', 'damage'], ['fragment', 'fragments']);
        const colour = make(
            'select', {
                id: 'colour',
                onchange: () => {
                    this.colouring = colour.value;
                    this.show(this.frame);
                }
            },
            ...names.map(([value, textContent]) => make('option', {value, textContent})));
        colour.value = this.colouring;
        this.factor = make('input', {
            id: 'factor',
            type: 'number',
            min: 0,
            step: 'any',
            onchange: () => {
                this.scale = Number(this.factor.value) || 0;
                this.show(this.frame);
            }
        });
        this.factor.style.width = '6em';
        const directions = {corner: CORNER_VIEW, x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1]};
        const looks =
            Object.entries(directions).map(([textContent,
                                             from]) => make('button', {textContent, onclick: () => this.look(from)}));
        return make(
            'div', {className: 'controls'}, make('label', {}, 'colour', colour),
            make('label', {}, 'displacement ×', this.factor), make('span', {}, 'view ', ...looks), ...this.makeParts(),
            this.makeCut());
    }

    /* What is shown at all. */
    makeParts() {
        const solid = (show) => {
            this.solid.outside.visible = show;
            if (this.solid.spheres) this.solid.spheres.visible = show;
        };
        const cracks = (show) => {
            this.solid.cracks.visible = show;
            if (this.solid.discs) this.solid.discs.visible = show;
        };
        const parts = [['solid', solid]];
        if (this.head.fracture) parts.push(['cracks', cracks]);
        if (this.head.rigid)
            parts.push([
                'rigid bodies',
                (show) => {
                    this.solid.rigid.visible = show;
                }
            ]);
        return parts.map(([name, set]) => {
            const box = make('input', {
                type: 'checkbox',
                checked: true,
                onchange: () => {
                    set(box.checked);
                    this.draw();
                }
            });
            return make('label', {}, box, name);
        });
    }

    makeCut() {
        const axis = make('select', {}, ...['none', 'x', 'y', 'z'].map((textContent) => make('option', {textContent})));
        const at =
            make('input', {type: 'range', min: 0, max: 1, step: 0.005, value: 0.5, ariaLabel: 'place of the cut'});
        const set = () => {
            const c = ['x', 'y', 'z'].indexOf(axis.value), box = new this.three.Box3().setFromArray(this.solid.place);
            const low = box.min.getComponent(Math.max(c, 0)), high = box.max.getComponent(Math.max(c, 0));
            this.solid.setCut(c, low + (high - low) * Number(at.value));
            this.draw();
        };
        axis.onchange = at.oninput = set;
        return make('label', {}, 'cut', axis, at);
    }

    /* All frames one after the other, once. */
    async run() {
        if (this.timer) {
            clearInterval(this.timer);
            this.timer = null;
            this.play.textContent = 'play';
            return;
        }
        this.play.textContent = 'pause';
        let next = this.frame + 1 < this.head.frames.length ? this.frame + 1 : 0;
        this.timer = setInterval(async () => {
            await this.show(next++);
            if (next === this.head.frames.length && this.timer) this.run();
        }, 150);
    }
}

function mostFrequent(numbers) {
    const count = new Map();
    for (const number of numbers) count.set(number, (count.get(number) || 0) + 1);
    return [...count].reduce((best, one) => one[1] > best[1] ? one : best, [0, 0])[0];
}
