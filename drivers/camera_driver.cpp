#include "drivers/camera_driver.h"
