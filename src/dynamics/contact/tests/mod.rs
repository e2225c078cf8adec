mod approach;
mod states;
