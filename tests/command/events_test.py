"""Plugins that pass messages on: an orders file publishes /start, a car drives to a wall, the wall tells of the touch, and that
sends a crate off, delayed. The same bits for any number of Simulators; the log tells the messages; a journal steps it again."""
import json
import unittest

from running import FOLDER, RobossTest, roboss, summary

BOX = """<inertial><mass>1</mass><inertia><ixx>.02</ixx><iyy>.02</iyy><izz>.02</izz></inertia></inertial>
<collision name="c"><geometry><box><size>.4 .4 .2</size></box></geometry>
<surface><friction><ode><mu>.1</mu><mu2>.1</mu2></ode></friction></surface></collision>"""
MOVES = '<plugin filename="gz-sim-velocity-control-system" name="gz::sim::systems::VelocityControl"/>'
TRIGGER = '<plugin filename="gz-sim-triggered-publisher-system" name="gz::sim::systems::TriggeredPublisher">{}</plugin>'
WORLD = f"""<sdf version="1.9"><world name="chain">
<physics name="p" type="ode"><max_step_size>0.002</max_step_size></physics>
<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision></link></model>
<model name="car"><pose>0 0 .1 0 0 0</pose><link name="body">{BOX}</link>{MOVES}</model>
<model name="crate"><pose>0 3 .1 0 0 0</pose><link name="body">{BOX}</link>{MOVES}</model>
<model name="wall"><static>1</static><pose>1 0 .5 0 0 0</pose><link name="body">
<collision name="c1"><geometry><box><size>.1 2 1</size></box></geometry></collision>
<sensor name="s" type="contact"><contact><collision>c1</collision></contact></sensor></link>
<plugin filename="gz-sim-touchplugin-system" name="gz::sim::systems::TouchPlugin">
<target>car</target><namespace>wall</namespace><time>0.02</time><enabled>true</enabled></plugin></model>
{TRIGGER.format('<input type="gz.msgs.Empty" topic="/start"/>'
                '<output type="gz.msgs.Twist" topic="/model/car/cmd_vel">linear: {x: 0.5}</output>')}
{TRIGGER.format('<input type="gz.msgs.Boolean" topic="/wall/touched"><match>data: true</match></input>'
                '<output type="gz.msgs.Twist" topic="/model/crate/cmd_vel">linear: {y: 0.4}</output>'
                '<output type="gz.msgs.StringMsg" topic="/report">data: "arrived"</output><delay_ms>100</delay_ms>')}
{TRIGGER.format('<input type="gz.msgs.Int32" topic="/keyboard/keypress"><match field="data">83</match></input>'
                '<output type="gz.msgs.Twist" topic="/model/crate/cmd_vel"/>')}
</world></sdf>"""
ORDERS = """{"t": 0.1, "publish": {"topic": "/start"}}
{"t": 2.5, "publish": {"topic": "/keyboard/keypress", "data": 83}}
"""


def written(name, text):
    file = FOLDER / name
    file.write_text(text)
    return file


class Events(RobossTest):
    @classmethod
    def setUpClass(cls):
        cls.world = written("chain.sdf", WORLD)
        cls.arguments = [cls.world, "--orders", written("chain.jsonl", ORDERS), "--until", "3", "--headless"]

    def test_check_lists_the_messages_and_what_becomes_of_the_plugins(self):
        report = json.loads(roboss("check", self.world, "--json").stdout)
        fates = [plugin["fate"] for plugin in report["plugins"] for _ in range(plugin["count"])]
        self.assertEqual(fates, ["runs"] * 6, report["plugins"])
        topics = {command["topic"] for type in report["commands"] for command in type["commands"]}
        for topic in ("/start", "/wall/touched", "/wall/enable", "/report", "/keyboard/keypress", "/model/{model}/cmd_vel"):
            self.assertIn(topic, topics)

    def test_the_chain_happens_and_the_log_tells_it(self):
        log = FOLDER / "chain.log"
        done = roboss("run", *self.arguments, "--quiet", "--log", log)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [line for line in log.read_text().splitlines() if "event=message" in line]
        text = "\n".join(lines)
        self.assertEqual(len(lines), 5, text)
        for line, words in zip(lines, ("/model/car/cmd_vel to car", "/wall/touched", "/model/crate/cmd_vel to crate", "/report",
                                       "/model/crate/cmd_vel to crate")):
            self.assertIn(words, line)
        ticks = [int(line.split("tick=")[1].split()[0]) for line in lines]
        self.assertEqual(ticks[0], 55, "published at tick 50, seen at the next observation")
        self.assertEqual(ticks[2] - ticks[1], 50, "100 ms later")
        self.assertEqual(ticks[4], 1255)

    def test_the_same_bits_for_any_number_of_simulators_and_from_a_journal(self):
        one = summary(*self.arguments)
        self.assertEqual(summary(*self.arguments, "--simulators", "3", "--threads", "2")["state_hash"], one["state_hash"])
        journal, saved = FOLDER / "chain.journal", FOLDER / "chain.roboss"
        self.assertEqual(summary(*self.arguments, "--journal", journal, "--journal-every", "0.7")["state_hash"], one["state_hash"])
        replayed = roboss("replay", journal, "--quiet", "--simulators", "3", "--window", "7")
        self.assertEqual(replayed.returncode, 0, replayed.stderr)
        self.assertIn(one["state_hash"], replayed.stdout, "orders are in the journal: a replay needs no program")
        for at in (0.3, 1.63, 1.69):
            again = summary(*self.arguments, "--from", f"{journal}@{at}")
            self.assertEqual(again["state_hash"], one["state_hash"], f"continued from {at} s")
        summary(*self.arguments[:-3], "--until", "1.73", "--headless", "--save", saved)
        self.assertEqual(summary(*self.arguments, "--from", saved)["state_hash"], one["state_hash"])

    def test_a_topic_that_nobody_takes_is_refused(self):
        orders = written("nobody.jsonl", '{"t": 0, "publish": {"topic": "/nobody"}}\n')
        self.refused(["run", self.world, "--orders", orders, "--until", "1", "--headless"], 1, "nobody.jsonl:1", "[bad-order]")


if __name__ == "__main__":
    unittest.main()
