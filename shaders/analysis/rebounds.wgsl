// Whether impacts chatter: rows of them at one stop, each slower than the one before.

var<private> rebounds: Rebounds;

fn rebounds_see(taken: Move) {
    if !is_impact(taken) {
        return;
    }
    let speed = abs(taken.velocity);
    let slower = taken.stop == rebounds.stop && speed < rebounds.last;
    rebounds.run = select(1u, rebounds.run + 1u, slower);
    rebounds.longest = max(rebounds.longest, rebounds.run);
    rebounds.last = speed;
    rebounds.stop = taken.stop;
}
