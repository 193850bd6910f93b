; KISSlicer - PRO
; Windows
; version 1.6.3
;
; Saved: 2026-03-02 12:49:09
; 'sample.gcode'
;
; *** Printer Settings ***
;
; num_extruders = 2
; ext_Xoff_1 = 0
; ext_Yoff_1 = 0
; ext_Xoff_2 = 25
; ext_Yoff_2 = 0.5
; ext_Xoff_3 = 0
; ext_Yoff_3 = 0
;
; *** Material Settings for Extruder 1 ***
;
; fiber_dia_mm = 2.85
;
; *** Material Settings for Extruder 2 ***
;
; fiber_dia_mm = 1.75
;
; *** G-code Prefix ***
G21
G90
M82
G28
; *** Main G-code ***
;
; BEGIN_LAYER_OBJECT z=0.200 z_thickness=0.200
;
; *** Selecting and Warming Extruder 1 to 215 C ***
; Select extruder, warm, purge
T0
M104 T0 S215
M109 T0 S215
;
; 'Skirt Path', 0.7 [feed mm/s], 30.0 [head mm/s]
G1 X-5.00 Y-5.00 Z0.200 F6000
G1 E0.000 F1800
G1 X15.00 Y-5.00 E0.6650 F1800
;
; 'Perimeter Path', 0.7 [feed mm/s], 18.4 [head mm/s]
G1 X0.00 Y0.00 F6000
G1 X10.00 Y0.00 E0.9970 F1104
G1 X10.00 Y10.00 E1.3290
;
; 'Loop Path', 0.7 [feed mm/s], 18.4 [head mm/s]
G1 X9.50 Y9.50 F6000
G1 X9.50 Y0.50 E1.6280 F1104
;
; 'Sparse Infill Path', 0.7 [feed mm/s], 18.4 [head mm/s]
G1 X9.00 Y1.00 F6000
G1 X1.00 Y9.00 E2.0040 F1104
;
; *** Selecting and Warming Extruder 2 to 215 C ***
T1
G92 E0
M109 T1 S215
; 'Prime Pillar Path', 0.7 [feed mm/s], 18.4 [head mm/s]
G1 X30.00 Y0.00 F6000
; 'Destring Prime'
G1 E0.0000 F1875
; head speed 18.4, filament speed 0.7, preload 0.000000
G1 X34.00 Y0.00 E0.1330 F1104
; 'Perimeter Path', 0.7 [feed mm/s], 18.4 [head mm/s]
G1 X12.00 Y0.00 F6000
G1 X20.00 Y0.00 E0.3990 F1104
; 'Destring/Wipe/Jump Path', 0.0 [feed mm/s], 100.0 [head mm/s]
G1 X18.00 Y0.00 F6000
;
; 'Support (may Stack) Path', 0.7 [feed mm/s], 18.4 [head mm/s]
G1 X12.00 Y4.00 F6000
G1 X20.00 Y4.00 E0.6650 F1104
; END_LAYER_OBJECT z=0.200
M104 T0 S0
M104 T1 S0
; Estimated Build Time:   1.50 minutes
