"""Starts the nodes of a lesson, for those who prefer `ros2 launch` to the command `apprentice`.

ros2 launch apprentice.launch.py scenario:=spoon headless:=true

The executable `apprentice` must be on the PATH (or given as executable:=...); a parameter file may be given instead
of a scenario with params_file:=....
"""

import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, PythonExpression

CONFIG = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
NODES = ["reward_posterior", "performance_bounds", "active_query"]
OF_A_TABLE = ["simulated_table", "placement_planner"]
OF_A_WORLD = ["simulated_world", "policy_optimizer"]


def node(name, condition=None, parameters=()):
    """One node as a process of its own, which is started again when it dies."""
    command = [
        LaunchConfiguration("executable"), name,
        "--ros-args", "--params-file", LaunchConfiguration("params_file"),
        "-r", ["__ns:=", LaunchConfiguration("namespace")],
        "--log-level", LaunchConfiguration("log_level"),
    ]
    for parameter in parameters:
        command += ["-p", parameter]
    return ExecuteProcess(
        cmd=command, name=name, output="screen", condition=condition, respawn=True, respawn_delay=1.0,
        sigterm_timeout="5", sigkill_timeout="5",
    )


def generate_launch_description():
    """Launch arguments, then the nodes; the recorder first."""
    bag = LaunchConfiguration("bag")
    simulated = PythonExpression(["'", LaunchConfiguration("demonstrator"), "' == 'simulated'"])
    recorded = PythonExpression(["'", bag, "' != ''"])
    of_a_world = ["'", LaunchConfiguration("about"), "' == 'world'"]
    is_world, is_table = IfCondition(PythonExpression(of_a_world)), UnlessCondition(PythonExpression(of_a_world))
    by_scenario = PythonExpression(["'world' if '", LaunchConfiguration("scenario"), "' in ('grid', 'driving') else 'table'"])
    scenario_file = [PathJoinSubstitution([CONFIG, LaunchConfiguration("scenario")]), ".yaml"]
    journal = ["journal:=", LaunchConfiguration("journal")]
    return LaunchDescription([
        DeclareLaunchArgument("executable", default_value="apprentice", description="the program"),
        DeclareLaunchArgument("scenario", default_value="flowers", description="flowers, spoon, grid or driving"),
        DeclareLaunchArgument("about", default_value=by_scenario, description="table or world"),
        DeclareLaunchArgument("params_file", default_value=scenario_file, description="parameters of all nodes"),
        DeclareLaunchArgument("namespace", default_value="/apprentice", description="where the topics are"),
        DeclareLaunchArgument("demonstrator", default_value="simulated", description="simulated or human"),
        DeclareLaunchArgument("headless", default_value="false", description="true leaves the page out"),
        DeclareLaunchArgument("bag", default_value="", description="folder for a recording; empty: none"),
        DeclareLaunchArgument("journal", default_value="''", description="file of accepted evidence; empty: none"),
        DeclareLaunchArgument("log_level", default_value="info", description="debug, info, warn or error"),
        node("session_recorder", IfCondition(recorded), [["output:=", bag]]),
        *[node(name, None, [journal] if name == "reward_posterior" else []) for name in NODES],
        *[node(name, is_table) for name in OF_A_TABLE],
        *[node(name, is_world) for name in OF_A_WORLD],
        node("operator_ui", UnlessCondition(LaunchConfiguration("headless"))),
        node("demonstrator", IfCondition(simulated)),
    ])
