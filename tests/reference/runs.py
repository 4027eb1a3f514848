"""What is run to compare two builds: commands by item, which run one after the other in a folder of the item's own.

{tree} and {nets} are what ships with a build, {old} is the folder of the old build's results; "new:" begins what only
the new build does."""
import tomllib

TICKS = 10_000
# What the plots may call a robot's velocity to the left; a new name is added here.
ACROSS = ["sideways", "velocity_left", "v_left"]
# What the shipped scripts are shown.
SCRIPTS = {"recorded_game": "game.mcap", "real_log": "--log {tree}/resources/logs/pioneer"}

# Conditions' names, of which the window exports every number exactly. ACROSS and TICKS are put in.
POSES = """
local function all(kind, count, names)
    for i = 1, count do
        for j = 1, #names do plot_expression(kind .. "[" .. i .. "]." .. names[j]) end
    end
end
local names = {"x", "y", "heading", "v", "w", "speed", "command_v", "command_w", "touching", "kicked"}
all("robot", #robot, names)
all("person", #person, names)
all("object", #object, {"x", "y", "heading", "vx", "vy", "w", "touching"})
for i = 1, #goals do plot_expression("goals[" .. i .. "]") end
for i = 1, #robot + #person do plot(i, "ACROSS") end
seek_tick(TICKS)
export_values("poses.csv")
"""


def pose_scripts():
    """Name -> text; each calls the velocity to the left otherwise."""
    return {across: POSES.replace("ACROSS", across).replace("TICKS", str(TICKS)) for across in ACROSS}


def scenario(file):
    tick = tomllib.loads(file.read_text()).get("tick_s", 0.02)
    return [
        f"mrose run {file.name} --duration {TICKS * tick:g} --record decisions.mcap --json --quiet > run.json",
        f"mrose-gui --offscreen --script {{across}}.lua {file.name}",
        "new: mrose replay {old}/decisions.mcap --json --quiet > replay.json",
        "new: mrose replay {old}/decisions.mcap --decide --json --quiet > replay_decide.json",
    ]


def trained(log, **networks):
    """Networks of a few epochs, as files and by what they predict."""
    commands = []
    for name, flags in networks.items():
        commands.append(f"mrose train {log} {flags} -o {name}.net --threads 1 --quiet")
        commands.append(f"mrose evaluate {name}.net --log {log} --json > {name}.json")
    return commands


def evaluated(net, log, flags=""):
    return [
        f"mrose evaluate {{nets}}/{net} --log {log} {flags} --json --report report > {net}.json",
        f"mrose predict {{nets}}/{net} --log {log} --windows report/windows.csv -o {net}.csv --quiet",
    ]


def compared(**flags):
    """The first with its tables of all rollouts."""
    return [
        f"mrose compare {what} --threads 1 --quiet --json {'' if i else '--report report'} > {name}.json"
        for i, (name, what) in enumerate(flags.items())
    ]


def items(tree):
    """Name -> commands."""
    six, seven, husky = "MRCLAM_Dataset6", "MRCLAM_Dataset7", "husky_windows.csv"
    pioneer = "{tree}/resources/logs/pioneer"
    paper = "{nets}/create_paper.net"
    seven_flags = f"--log {seven} --robots 1,2"
    scripts = [file.stem for file in sorted((tree / "resources/scripts").glob("*.lua"))]
    all_items = {file.stem: scenario(file) for file in sorted((tree / "resources/scenarios").glob("*.toml"))}
    return all_items | {
        "learned on MRCLAM 6": trained(six, usual="--epochs 3", paper="--epochs 40 --model paper"),
        "compare MRCLAM 6": compared(
            once=f"mrclam_replay.toml --log {six}", every=f"mrclam_replay.toml --log {six} --every 10"
        ),
        "create.net on MRCLAM 6": evaluated("create.net", six, f"--against {paper}")[:1],
        "create.net on MRCLAM 7": [
            *evaluated("create.net", seven, f"--robots 1,2 --against {paper}"),
            f"mrose predict {paper} --log {seven} --windows report/windows.csv -o create_paper.net.csv --quiet",
        ],
        "compare MRCLAM 7": compared(
            once=seven_flags, every=f"{seven_flags} --every 10", windows=f"{seven_flags} --windows all"
        ),
        "husky.net": [
            *evaluated("husky.net", husky),
            f"mrose evaluate {{nets}}/husky.net --log {husky} --held-out --json > held_out.json",
        ],
        "compare husky": compared(once=f"--log {husky}"),
        "learned on husky": trained(husky, usual="--epochs 5 --hold-out 0.2"),
        "pioneer.net": [
            "mrose generate --set held-out --seed 2 -o drives --quiet",
            *evaluated("pioneer.net", "drives"),
        ],
        "compare shipped log": compared(once=f"--log {pioneer}"),
        "learned on shipped log": trained(
            pioneer,
            history="--epochs 60",
            state="--epochs 60 --model state",
            velocity="--epochs 60 --model velocity",
            paper="--epochs 60 --model paper",
            lm="--epochs 10 --model paper --method lm",
        ),
        "batch": ["mrose batch soccer.toml --trials 30 -o games --threads 1 --quiet"],
        "inspect": [f"mrose inspect {log} --json > {log.split('/')[-1]}.json" for log in (six, seven, husky, pioneer)],
        "window": ["mrose run soccer.toml --record game.mcap --quiet > game.txt"]
        + [
            f"mrose-gui --offscreen --script {{tree}}/resources/scripts/{name}.lua {SCRIPTS.get(name, '')} > {name}.txt"
            for name in scripts
        ],
    }


def needs_real_logs(commands):
    return any(log in command for command in commands for log in ("MRCLAM_", "husky_windows", "mrclam_replay"))


def networks_left_out(tree, commands):
    text = " ".join(sum(commands.values(), []))
    return [file.name for file in sorted((tree / "nets").glob("*.net")) if f"{{nets}}/{file.name}" not in text]
