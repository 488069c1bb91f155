// The cascade drive of cascade.py as blocks of Xcos, without its editor: cascade.py runs this by scilab-cli (Scilab 6.1) in
// a folder that holds pieces.csv (of constant jerk: where each begins [s], place, speed, acceleration there, its jerk [SI]),
// and reads seconds.csv and the table's place in place0.csv (solver LSODAR, what Xcos takes unless told otherwise) and place1.csv
// (CVODE, BDF). Blocks are wired by number, which is what Xcos' compiler makes of a drawing; corners of the move, the dead band
// of the screw and the limit of the torque are events. The move is a formula of time as here: integrated three times from its
// jerk it would drift by 0.7 mm.
loadXcosLibs();
funcprot(0);

function model = of(name, texts)
    // A block with these texts in its dialogue.
    %scicos_prob = %f; alreadyran = %f; needcompile = 4; %scicos_context = struct();
    scicos_getvalue = setvalue; getvalue = setvalue;
    execstr("block = " + name + "(""define"")");
    block.graphics.exprs = texts;
    execstr("block = " + name + "(""set"", block)");
    model = block.model;
endfunction
function model = law(inputs, text)
    // Its own zero crossings would overwrite memory (Scilab 6.1.1): left off.
    model = of("EXPRESSION", [string(inputs); text; "0"]);
endfunction
function model = integral()
    model = of("INTEGRAL_m", ["0"; "0"; "0"; "1"; "-1"]);
endfunction

lead = "0.0007957747154594768"; // of the screw [m/rad]
pieces = csvRead("pieces.csv");
function model = held(values)
    // Held between the corners of the move, which are events.
    block = CURVE_c("define");
    model = block.model;
    model.rpar = [pieces(:, 1); values];
    model.ipar = [size(pieces, 1); 0; 0];
endfunction

blocks = list();
for i = 1:5, blocks(i) = held(pieces(:, i)); end // begin, place, speed, acceleration, jerk
block = TIME_f("define");
blocks(6) = block.model;
blocks(7) = law(6, "u2+(u6-u1)*(u3+(u6-u1)*(u4/2+(u6-u1)*u5/6))"); // place that is wanted
blocks(8) = law(6, "u3+(u6-u1)*(u4+(u6-u1)*u5/2)"); // its speed
blocks(9) = law(6, "u4+(u6-u1)*u5"); // its acceleration
blocks(10) = law(4, "(60*(u1-" + lead + "*u3)+u2)/" + lead + "-u4"); // error of the speed
blocks(11) = integral();
blocks(12) = law(2, "0.5*u1+u2");
blocks(13) = of("SATURATION", ["10"; "-10"; "1"]);
blocks(14) = law(3, "60*u1+(u3-u2)*120");
blocks(15) = law(2, lead + "*u1-u2"); // how far the screw is ahead of the table
blocks(16) = law(2, lead + "*u1-u2"); // the rate of that
blocks(17) = of("DEADBAND", ["1e-5"; "-1e-5"; "1"]);
blocks(18) = law(2, "(u1>0)*max(0,50e6*u1+5e3*u2)+(u1<0)*min(0,50e6*u1+5e3*u2)"); // force on the table
blocks(19) = law(2, "u1*" + lead + "*0.5*(1/0.9+0.9)+abs(u1)*" + lead + "*0.5*(1/0.9-0.9)*tanh(u2/0.01)");
blocks(20) = law(4, "(u1+1.296426*u2-u3-1e-3*u4)/1e-3");
blocks(21) = integral(); // speed of the motor
blocks(22) = integral(); // its angle
blocks(23) = law(2, "(u1-200*u2)/50");
blocks(24) = integral(); // speed of the table
blocks(25) = integral(); // its place
blocks(26) = of("TOWS_c", ["40001"; "place"; "0"]);
blocks(27) = of("EVTDLY_c", ["0.00025"; "0"]);

wires = [7 10 1; 8 10 2; 22 10 3; 21 10 4; 14 11 1; 10 12 1; 11 12 2; 12 13 1; 10 14 1; 12 14 2; 13 14 3; ..
         22 15 1; 25 15 2; 21 16 1; 24 16 2; 15 17 1; 17 18 1; 16 18 2; 18 19 1; 21 19 2; 13 20 1; 9 20 2; 19 20 3; 21 20 4; ..
         20 21 1; 21 22 1; 18 23 1; 24 23 2; 23 24 1; 24 25 1; 25 26 1]; // from block, to block, to port
for i = 1:6
    wires = [wires; i 7 i; i 8 i; i 9 i];
end
n = size(wires, 1);
events = [1 1 1 1; 2 1 2 1; 3 1 3 1; 4 1 4 1; 5 1 5 1; 27 1 27 1; 27 1 26 1];
numbers = list();
for i = 1:length(blocks), numbers(i) = i; end
program = c_pass2(blocks, [wires(:, 1), ones(n, 1), wires(:, 2:3)], events, numbers, numbers, "silent");

seconds = [];
for solver = [0 1]
    used = [];
    for run = 1:5
        tolerances = [1e-8; 1e-6; 1e-10; 11; 0; solver; 0];
        timer();
        [state, now] = scicosim(program.state, 0, 10, program.sim, "start", tolerances);
        [state, now] = scicosim(state, 0, 10, program.sim, "run", tolerances);
        [state, now] = scicosim(state, 10, 10, program.sim, "finish", tolerances);
        used = [used; timer()];
    end
    seconds = [seconds; median(used)];
    csvWrite(place_val, "place" + string(solver) + ".csv", ",", ".", "%.17g");
end
csvWrite(seconds, "seconds.csv");
exit
