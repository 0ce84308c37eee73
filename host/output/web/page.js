/* Starts the page: the view first, then the charts. document.body.dataset.first and .ready hold the milliseconds from
 * the start of loading to the first picture of the view and to everything; .failed what went wrong. */
async function startView(touching) {
    const place = document.getElementById("view"), head = JSON.parse(document.getElementById("view-data").textContent);
    if (head.no_view) place.append(make("p", {textContent: `No view: ${head.no_view}`}));
    if (!head.view) return null;
    const view = new View(place, head.view, touching);
    try {
        await view.start(await library("three.mjs.gz"));
    } catch (error) {
        if (!/WebGL/.test(error.message)) throw error;
        place.append(make("p", {textContent: "No view: this browser offers no WebGL."}));
        return null;
    }
    await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
    document.body.dataset.first = Math.round(performance.now());
    return view;
}

async function startCharts(data, view) {
    const curves = document.getElementById("curves"), cracks = document.getElementById("cracks");
    if (!data.histories && !data.fragments && !data.roses) return;
    const {aS: echarts} = await library("echarts.mjs.gz"); /* the name that the bundle gives the module */
    if (data.histories) {
        const sensors = new Curves(curves, data.histories, await unpack("histories"));
        if (view) view.listeners.push((frame) => sensors.mark(view.head.frames[frame]));
        if (view) sensors.mark(view.head.frames[view.frame]);
        sensors.start(echarts);
    }
    cracks.className = "beside";
    if (data.fragments) {
        const fragments =
            new Fragments(cracks.appendChild(make("div")), data.fragments, await unpack("fragment-masses"));
        fragments.start(echarts);
        if (view) view.listeners.push((frame) => fragments.show(view.head.frames[frame].number));
    }
    if (data.roses) new Rose(cracks.appendChild(make("div")), data.roses).start(echarts);
}

async function startPage() {
    try {
        const data = JSON.parse(document.getElementById("data").textContent);
        await startCharts(data, await startView(data.touching));
        document.body.dataset.ready = Math.round(performance.now());
    } catch (error) {
        document.body.dataset.failed = error.message;
        throw error;
    }
}

startPage();
