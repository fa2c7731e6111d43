# Seconds that the longest tests take, about: ctest starts these first, also on a machine without the
# times of an earlier run, so that its last processors have short tests to do.
set(PCL_ALS_TEST_SECONDS
  155 test_demo
  85 test_block_calibration test_iterative_closest_patch
  80 test_real_blocks
  75 test_conical_scanner test_prior_of_missions test_processes_folder
  70 test_channels test_diagnosis test_large_corrections test_wrong_trajectory
  65 test_calibration_problems test_round_trip test_system_calibration
  55 test_calibration_intervals test_robustness
  50 test_report
  45 test_fixed_information test_malicious_files test_options test_prior test_stated_misfit
  40 manual_commands test_check test_partial_data test_target_location test_targets
  30 architecture_self_test python_test_calibration test_block_offset test_classify
    test_pictures test_scan_angles
  25 python_test_examples test_determinability test_trajectory_files
  20 test_feet test_file_uncertainty test_las_versions test_orient test_real_checks test_schemas
    test_simulated_waveforms test_waveform_packets
  15 python_test_jobs test_bundle_adjustment test_held_surfaces test_las_input test_laz
    test_output test_plan test_quaternions test_reconstruction test_roof_lines
    test_simulator_noise test_strip_check test_systems test_text_inputs test_time_gaps
    test_trajectory_outliers
  10 python_test_wrong_arguments strip_benchmark_block test_convert test_copc_tools
    test_file_correction test_intensity test_mounting test_pulse_estimate test_shared_work
    test_survey_input test_undetermined test_wrong_boxes)

# Sets the costs of the tests of the current folder; at the end of its CMakeLists.txt.
function(als_set_test_costs)
  get_property(tests DIRECTORY PROPERTY TESTS)
  set(seconds 0)
  foreach(word IN LISTS PCL_ALS_TEST_SECONDS)
    if(word MATCHES "^[0-9]+$")
      set(seconds ${word})
    elseif(word IN_LIST tests)
      set_tests_properties(${word} PROPERTIES COST ${seconds})
    endif()
  endforeach()
endfunction()
