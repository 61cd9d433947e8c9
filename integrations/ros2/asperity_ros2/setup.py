from setuptools import setup

setup(
    name="asperity_ros2",
    version="0.2.0",
    packages=["asperity_ros2"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/asperity_ros2"]),
        ("share/asperity_ros2", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    maintainer="Asperity",
    maintainer_email="asperity@example.org",
    description="Forces of surfaces measured by Asperity: a node from poses to wrenches",
    license="BSD-3-Clause",
    entry_points={"console_scripts": ["feel = asperity_ros2.feel_node:main"]},
)
