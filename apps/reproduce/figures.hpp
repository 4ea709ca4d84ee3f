#pragma once
/// The figures of the paper, each with its data. Each function computes, writes the data and leaves the picture with
/// the study.
#include "reproduce/study.hpp"

namespace slapstick::paper {

void fig2(Study& study);         ///< bifurcation diagram; and fig2-sliding: both readings of t_f
void fig3_to_5(Study& study);    ///< motions at 1.5; 2.2 and 2.0; 0.552
void fig6(Study& study);         ///< three routes to chaos
void fig7(Study& study);         ///< the impact section at 4.801 and 4.805
void fig8(Study& study);         ///< the diagram for six friction values
void fig_printed(Study& study);  ///< the diagram with the printed restitution, and with f_k < f_s

/// In gnuplot's notation.
inline const std::string omega_label = "forcing frequency {/:Italic ω}";
inline const std::string velocity_label = "{/:Italic ẋ}_2 – {/:Italic ẋ}_1";

}  // namespace slapstick::paper
