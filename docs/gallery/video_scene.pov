// SPDX-License-Identifier: GPL-3.0-or-later
//
// The clip of the gallery: three balls roll past each other in front of a camera that moves. POV-Ray
// renders it (docs/gallery/video.py); clock goes from 0 to 1.
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera {
  location <-0.8 + 1.6 * clock, 2.2, -6>
  look_at <0, 0.9, 0>
  right x * image_width / image_height
}
light_source { <6, 9, -8> rgb 1 }
light_source { <-7, 5, -3> rgb 0.35 shadowless }
sky_sphere {
  pigment { gradient y color_map { [0 rgb <0.75, 0.82, 0.9>] [0.6 rgb <0.25, 0.4, 0.65>] } }
}
plane {
  y, 0
  pigment { checker rgb <0.75, 0.7, 0.6> rgb <0.35, 0.38, 0.33> scale 1.1 }
}

// A ball that rolls along x from `from` to `to`.
#macro Ball(From, To, Depth, Radius, Light, Dark)
  #local Place = From + (To - From) * clock;
  sphere {
    0, Radius
    pigment {
      marble turbulence 0.6 scale 0.6 * Radius
      color_map { [0 rgb Dark] [0.5 rgb Light] [1 rgb Dark] }
    }
    finish { phong 0.4 phong_size 30 }
    rotate z * -degrees(Place / Radius)
    translate <Place, Radius, Depth>
  }
#end
Ball(-3.2, 2.6, 0.4, 1.0, <0.95, 0.85, 0.6>, <0.7, 0.25, 0.1>)
Ball(3.4, -2.0, 2.2, 1.3, <0.75, 0.85, 0.95>, <0.15, 0.3, 0.5>)
Ball(1.6, -1.9, -1.6, 0.5, <0.9, 0.95, 0.75>, <0.2, 0.45, 0.15>)
