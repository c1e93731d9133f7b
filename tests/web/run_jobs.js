// Runs the program of a page without a page: run_jobs.js FOLDER WORK WIDTH HEIGHT.
// In: WORK/jobs.json, a list of scenes with an instant or the name of a film. Out: WORK/0, WORK/1, …,
// the PNG or MP4 of each.
const fs = require('fs');
const path = require('path');

const [folder, work, width, height] = process.argv.slice(2);

require(path.join(folder, 'piblocks_live.js'))().then((module) => {
  const call = (name, ...values) => {
    const done = module.ccall(name, 'boolean', values.map((value) => (typeof value)), values);
    const answer = module.ccall('live_answer', 'string', [], []);
    if (!done) throw new Error(`${name} ${values.slice(-2).join(' ')}: ${answer}`);
    return answer;
  };
  JSON.parse(fs.readFileSync(path.join(work, 'jobs.json'))).forEach((job, number) => {
    const text = fs.readFileSync(job.scene, 'utf8');
    const settings = [`view.size=${width}x${height}`];
    if (job.film) settings.push('sound.on=false');
    else if (!text.includes('[[part]]')) settings.push('time.allow-uncertain=true');
    call('live_open', text, settings.join('\n'), '');
    const file = job.film ? '/film.mp4' : '/still.png';
    if (job.film) {
      call('live_render', file, 1, 1);
    } else {
      call('live_show', `instant ${job.instant}`);
      call('live_save', file);
    }
    fs.writeFileSync(path.join(work, String(number)), module.FS.readFile(file));
  });
}).catch((error) => {
  console.error(String(error.message || error));
  process.exit(1);
});
