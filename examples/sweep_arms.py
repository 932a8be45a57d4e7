"""Which lengths of arms and rods suit the path of appendix B (Pollard thesis, chapter 5)?

Finer, and with the upper arm: docs/sweep.md has the command and what it finds.
"""

import pollard_pin
import thesis_pin

if __name__ == "__main__":  # processes of a sweep begin by reading this file again
    study = pollard_pin.path_study(samples=401)
    varied = ["chain_*.x_43=0.32:0.36:3", "chain_*.x_87=0.31:0.35:3"]
    designs = thesis_pin.make_designs(study, varied)
    sweep = thesis_pin.sweep_designs(study, designs, jobs=2)

    choice = thesis_pin.Choice.of(sweep)
    torque, margin = sweep.numbers("base_torque"), sweep.numbers("reach_margin")
    for k in choice.front:
        print(f"{', '.join(choice.values(k))}: {torque[k]:.3f} N·m, reach margin {margin[k]:.3f}")
    print(*choice.sentences(), sep="\n")
